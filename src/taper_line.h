// SPDX-License-Identifier: BSD-3-Clause
// Private. Where a line comes deepest into a tapered superquadric.
#pragma once

#include "pcl_sq/tapered_superquadric.h"

namespace pcl_sq::detail {

/** \brief The smallest gauge along a line: below one where the line meets the body.
 * \param[in] direction need not be of unit length
 * \param[out] at its place, origin + at * direction; untouched if the line misses the
 * body's box, where the result is infinite */
double smallestGauge(const TaperedSuperquadric& superquadric,
                     const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction,
                     double& at);

} // namespace pcl_sq::detail
