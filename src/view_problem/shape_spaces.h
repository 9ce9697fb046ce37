// SPDX-License-Identifier: BSD-3-Clause
// Private. In which directions the members of a family may move.
#pragma once

#include "pcl_sq/view_fit.h"
#include "solver/descriptions.h"
#include "solver/levenberg_marquardt.h"
#include "tuning/view_tuning.h"

namespace pcl_sq::detail {

using tuning::view_problem::UPRIGHT;

/** \brief Turned as little as possible so that axis \a k is parallel to \a up. */
Superquadric upright(const Superquadric& m, int k, const Eigen::Vector3d& up);

/** \brief The free directions of a family. */
ParameterSpace spaceOf(ShapeClass shape);

/** \brief Takes the directions of the space out that turn any axis but \a k. */
ParameterSpace standing(const ParameterSpace& space, int k);

} // namespace pcl_sq::detail
