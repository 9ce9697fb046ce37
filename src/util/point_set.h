// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace pcl_sq::detail {

// Points: Eigen::Ref<const Eigen::Matrix3Xd>, Eigen::Matrix3Xd or CloudPoints.

/** \brief First and second moments of the finite points. */
struct Moments {
  std::size_t count = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

template <typename Points>
Moments momentsOf(const Points& points);

/** \brief Dimensions that the points span: 0 (one place), 1 (a line), 2 (a plane), 3.
 * Thickness within the rounding of single-precision coordinates does not count. */
template <typename Points>
int spannedDimensions(const Points& points);

} // namespace pcl_sq::detail
