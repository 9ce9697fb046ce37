// SPDX-License-Identifier: BSD-3-Clause
// Private. The two ways to observe an object: in an image, or as bare points.
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

[[nodiscard]] bool observeImage(Observation& o, std::string& why);
[[nodiscard]] bool observeBare(Observation& o, std::string& why);

/** \brief Checks a table against the object's points; drops it with a note if they lie
 * below it. */
void checkTable(ObservedObject& observed);

/** \brief Points lower than this above a table may be the table's [m]. */
inline double standingHeight(const TableModel& table, double depth) {
  return std::max(4.0 * table.noise, 0.003 * depth);
}

/** \brief How far each point's surface moves along its normal when the measurement
 * belongs a pixel beside the point's own [m]. */
Eigen::VectorXf sidewaysErrors(const Observation& o);

/** \brief Extent and depth from the points. */
void measure(ObservedObject& observed);

/** \brief Whether points look as if a camera at the origin, looking along z, has seen
 * them: far enough before it, and hardly any ray meets two layers of them. */
bool isCameraFrame(const Eigen::Matrix3Xd& points);

} // namespace pcl_sq::detail
