// SPDX-License-Identifier: BSD-3-Clause
// Private. What is looked at.
#pragma once

#include "pcl_sq/impl/scene_estimation.hpp"

namespace pcl_sq::detail {

constexpr double CORRELATION = 7.0; ///< side of the square that shares its errors [px]
/** \brief Tangent of the steepest slope to the ray at which a surface is still seen:
 * depth cameras see nothing below some 10 degrees. */
constexpr double STEEPEST = 5.0;

/** \brief An organized cloud in its camera's frame and what is known of it. */
struct SceneView {
  const CloudPoints& points;
  int width, height;
  const ColorMatrix& colors; ///< of each point; all one where there are none
  PinholeCamera camera;      ///< at the origin
  TableModel table;          ///< in the camera's frame
  unsigned int threads = 1;  ///< 0: all cores

  bool finite(int c) const { return points.col(c).allFinite(); }
  Eigen::Vector3d at(int c) const { return points.col(c).cast<double>(); }
};

} // namespace pcl_sq::detail
