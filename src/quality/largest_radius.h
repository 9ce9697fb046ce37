// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq::detail {

/** \brief Largest distance of the union's surface from a point [m], what GraspIt! takes
 * as the length of torques. */
double largestRadius(const MultiSuperquadric& model, const Eigen::Vector3d& from);

} // namespace pcl_sq::detail
