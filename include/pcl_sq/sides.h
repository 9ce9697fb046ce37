// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/oriented_box.h"
#include "pcl_sq/tapered_union.h"

#include <optional>

namespace pcl_sq {

/** \brief The smallest box around a superquadric with one side along its z: what a
 * ruler would measure.
 *
 * It lies along the axes up to e2 = 1. A section of larger e2 is a diamond, whose sides
 * run between the axes: with e2 = 2 and a1 = a2 = a the body's section is a square of
 * sides sqrt(2) a, turned by 45 degrees. */
PCL_SQ_EXPORTS OrientedBox boxAround(const Superquadric& superquadric);

/** \brief Sides of boxAround() [m]; up to e2 = 1 twice the semi-axes. The third is
 * along z, the first of the other two is that nearer to x. */
PCL_SQ_EXPORTS Eigen::Vector3d sidesOf(const Superquadric& superquadric);

/** \brief The smallest upright box around a union, tapers included.
 * \param[in] up unit vector; without it the axis of a part whose box is the smallest
 * \return its third axis is upwards, or the one that was found; the first side is the
 * longer of the other two. A box without sides for an empty union */
PCL_SQ_EXPORTS OrientedBox boxAround(
    const TaperedUnion& model, const std::optional<Eigen::Vector3d>& up = std::nullopt);

} // namespace pcl_sq
