// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

namespace pcl_sq::detail {

/** \brief ln of the surface's area with its derivatives for ln a1, ln a2, ln a3, e1,
 * e2.
 */
struct LogArea {
  double value = 0.0;
  Eigen::Matrix<double, 5, 1> gradient = Eigen::Matrix<double, 5, 1>::Zero();
};

/** \brief Area to about one per cent, in the time of a few points' residuals.
 *
 * The area vectors of the superquadric with unit semi-axes are tabulated over the
 * exponents; semi-axes scale their components by the cofactors a2 a3, a3 a1, a1 a2. */
LogArea logArea(const Eigen::Vector3d& semi_axes, double epsilon1, double epsilon2);

} // namespace pcl_sq::detail
