// SPDX-License-Identifier: BSD-3-Clause
// Private. The surface of a union, and what of it lies inside of other parts.
#pragma once

#include "pcl_sq/superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief A surface in small pieces. */
struct SurfaceCells {
  Eigen::Matrix3Xd middles; ///< [m]
  Eigen::ArrayXd areas;     ///< [m^2]
};

SurfaceCells surfaceCells(const Superquadric& part);

/** \brief Area of the surface of a union, without what lies inside of it [m^2]. */
double exposedArea(const std::vector<Superquadric>& parts);

/** \brief Replaces distances of points by those to a body where they are smaller.
 * Points whose distance to it is sure to exceed their reach may keep theirs [m]. */
void keepNearer(const Superquadric& body,
                const Eigen::Matrix3Xd& points,
                const Eigen::ArrayXd& reach,
                Eigen::VectorXd& distances);

} // namespace pcl_sq::detail
