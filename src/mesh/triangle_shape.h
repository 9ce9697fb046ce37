// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_sq::detail {

/** \brief Normal of a triangle, as long as twice its area. */
inline Eigen::Vector3d doubleArea(const std::array<Eigen::Vector3d, 3>& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

/** \brief Height of a triangle over its longest side, 0.87 of an equilateral one. */
inline double shapeOf(const std::array<Eigen::Vector3d, 3>& t) {
  const double side = std::max({(t[1] - t[0]).squaredNorm(),
                                (t[2] - t[1]).squaredNorm(),
                                (t[0] - t[2]).squaredNorm()});
  return side > 0.0 ? doubleArea(t).norm() / side : 0.0;
}

/** \brief Distance of a point from the segment between a and b. */
inline double segmentDistance(const Eigen::Vector3d& p,
                              const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b) {
  const Eigen::Vector3d side = b - a;
  const double length = std::max(side.squaredNorm(), 1e-300);
  return (p - a - std::clamp((p - a).dot(side) / length, 0.0, 1.0) * side).norm();
}

/** \brief Distance of a point from a triangle. */
inline double triangleDistance(const Eigen::Vector3d& p,
                               const std::array<Eigen::Vector3d, 3>& t) {
  const Eigen::Vector3d normal = doubleArea(t);
  double nearest = std::numeric_limits<double>::infinity();
  bool above = true;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = t[i], &b = t[(i + 1) % 3];
    above = above && normal.dot((b - a).cross(p - a)) >= 0.0;
    nearest = std::min(nearest, segmentDistance(p, a, b));
  }
  return above && normal.norm() > 0.0 ? std::abs(normal.dot(p - t[0])) / normal.norm()
                                      : nearest;
}

} // namespace pcl_sq::detail
