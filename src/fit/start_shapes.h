// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/normalisation.h"

namespace pcl_sq::detail {

/** \brief Starts from the moments and extents of the points: each axis in turn as that
 * of epsilon1; an ellipsoid, a box, and a box turned by 45 degrees. */
std::vector<Superquadric> startShapes(const UnitPoints& dense);

/** \brief Further starts, for clouds of which the first ones explain too little:
 * centres pushed towards either end of each axis, octahedra, frames between the axes,
 * boxes along the axes of a fit whose sides may be wrong although its axes are not. */
std::vector<Superquadric> furtherStartShapes(const UnitPoints& dense,
                                             const Superquadric& fit);

/** \brief Other descriptions of about the same body, as starts: the axes in other
 * order, the dual cross-section (Liu et al. 2022), and both. */
std::vector<Superquadric> otherDescriptions(const Superquadric& model);

} // namespace pcl_sq::detail
