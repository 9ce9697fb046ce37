// SPDX-License-Identifier: BSD-3-Clause
// Private. An object that is being observed: what is known, and what becomes known.
#pragma once

#include "pcl_sq/object_view.h"

#include <algorithm>

namespace pcl_sq::detail {

/** \brief Input and output of an observation. */
struct Observation {
  const CloudPoints& points;
  int width, height;
  const std::vector<int>& object;
  const ViewOptions& view;
  ObservedObject& out;

  Eigen::Vector3d at(int column) const { return points.col(column).cast<double>(); }
  bool finite(int column) const { return points.col(column).allFinite(); }
};

constexpr int MIN_IMAGE_POINTS = 30; ///< of an object in an image

/** \brief Points lower than this above a table may be the table's [m]. */
inline double standingHeight(const TableModel& table, double depth) {
  return std::max(4.0 * table.noise, 0.003 * depth);
}

} // namespace pcl_sq::detail
