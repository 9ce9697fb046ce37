// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/lines.h"
#include "input/scalar.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief One of a point's fields in a PCD file. */
struct PcdField {
  std::string name;
  Scalar type = Scalar::F32;
  std::uint64_t count = 1;    ///< numbers of a point
  std::uint64_t offset = 0;   ///< bytes of a point before it
  std::uint64_t position = 0; ///< numbers of a point before it
};

/** \brief What the header of a PCD file says, held against the bytes behind it. */
struct PcdHeader {
  std::string kind; ///< of its data: ascii, binary or binary_compressed
  std::vector<PcdField> fields;
  std::size_t axes[3] = {}; ///< places of x, y and z among the fields
  int color = -1;           ///< place of the colour, or -1
  std::uint64_t point_bytes = 0, point_values = 0, total = 0;
  std::uint32_t width = 0, height = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/** \brief Reads up to the line DATA. \throws Failure where it contradicts itself or
 * promises more than the file holds */
PcdHeader readPcdHeader(Lines& lines);

} // namespace pcl_sq::app
