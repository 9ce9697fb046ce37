// SPDX-License-Identifier: BSD-3-Clause
// Private. What stands off a vessel.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

Eigen::Vector3d meanOf(const Eigen::Matrix3Xd& points, const std::vector<int>& columns);

/** \brief The ellipsoid around the points of a handle, an axis outwards from the body:
 * what is left to say where no fit comes near the points. */
Superquadric aroundPoints(const Eigen::Matrix3Xd& points,
                          const std::vector<int>& columns,
                          const Superquadric& body);

} // namespace pcl_sq::detail
