// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_sq {

/** \brief Triangles of a superquadric for a picture, with exact normals.
 *
 * A product of two profile curves whose points are dense where the curve is long or
 * turns sharply: edges stay edges down to an exponent of 0.05 and up to 2. (The mesh of
 * triangle_mesh.h is made for export and measurement instead: even triangles.) */
struct DisplaySurface {
  std::vector<Eigen::Vector3d> vertices; ///< in the cloud's frame [m]
  std::vector<Eigen::Vector3d> normals;  ///< unit length, outward
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /** \brief Polylines of vertices along edges that the eye expects to be drawn. */
  std::vector<std::vector<std::uint32_t>> edges;
};

/** \param[in] steps points along a quarter of a profile, at least 4 */
DisplaySurface displaySurface(const Superquadric& superquadric, int steps = 28);

/** \brief Ends of segments (2i and 2i + 1) of the outline: where the surface turns away
 * from the eye. \param[in] to_eye direction from each vertex to the eye */
std::vector<Eigen::Vector3d> outline(const DisplaySurface& surface,
                                     const std::vector<Eigen::Vector3d>& to_eye);

} // namespace pcl_sq
