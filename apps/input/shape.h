// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_sq::app {

/** \brief What a file of points or triangles holds: its own numbers, unit and frame. */
struct Shape {
  std::vector<Eigen::Vector3d> points; ///< not finite where there is none
  std::vector<std::uint32_t> colors;   ///< 0xRRGGBB, one for each point; or empty
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< valid indices into points
  std::size_t faces = 0;                 ///< polygons that the triangles were cut from
  std::uint32_t width = 0, height = 0;   ///< of an image of points; 0 for a list
  Eigen::Vector3d origin{0.0, 0.0, 0.0}; ///< of the sensor
  Eigen::Quaterniond orientation{1.0, 0.0, 0.0, 0.0}; ///< of the sensor
  std::string unit; ///< that the file names: m, cm, mm or in; empty if it names none
  std::vector<std::string> notes; ///< what was assumed, without full stops
};

/** \brief Reads PCD, PLY, OBJ, STL or lines of numbers. What the bytes start with
 * decides; the extension (".xyz") only where they do not tell. Nothing is allocated
 * that the bytes cannot back, and every loop takes bytes: no contents make it slow,
 * large or wrong in silence. \throw Failure, what is wrong and in which line or field,
 * without the file's name */
Shape readShape(std::string_view bytes, const std::string& extension);

/** \brief The readers behind readShape(); \a bytes have no byte-order mark. */
Shape readPcd(std::string_view bytes);
Shape readPly(std::string_view bytes);
Shape readObj(std::string_view bytes);
Shape readStl(std::string_view bytes);
Shape readText(std::string_view bytes);

/** \brief Whether the bytes are a binary STL: their number says so. */
bool isBinaryStl(std::string_view bytes);

/** \brief Cuts a polygon into triangles about its first corner.
 * \return false if a corner is none of the points */
bool addFace(const std::vector<std::int64_t>& corners, Shape& shape);

/** \brief Cuts strips of triangles, negative numbers between them, into \a faces. */
void cutStrips(const std::vector<double>& strips,
               std::vector<std::vector<std::int64_t>>& faces);

} // namespace pcl_sq::app
