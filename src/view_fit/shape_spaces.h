// SPDX-License-Identifier: BSD-3-Clause
// Private. In which directions the members of a family may move.
#pragma once

#include "pcl_sq/view_fit.h"
#include "solver/levenberg_marquardt.h"

namespace pcl_sq::detail {

/** \brief Cosine of the largest angle to the table's normal of an axis that may be
 * upright, 0.35 rad. */
inline constexpr double UPRIGHT = 0.9394;

/** \brief The same body with its axes permuted cyclically so that axis \a k is z. */
Superquadric withAxis(const Superquadric& m, int k);

/** \brief The dual description of the cross-section: turned by 45 degrees about z,
 * e2 -> 2 - e2 (Liu et al. 2022): a box may hide behind a bevelled diamond. */
Superquadric dual(const Superquadric& m);

/** \brief Turned as little as possible so that axis \a k is parallel to \a up. */
Superquadric upright(const Superquadric& m, int k, const Eigen::Vector3d& up);

/** \brief The free directions of a family. */
ParameterSpace spaceOf(ShapeClass shape);

/** \brief Takes the directions of the space out that turn any axis but \a k. */
ParameterSpace standing(const ParameterSpace& space, int k);

} // namespace pcl_sq::detail
