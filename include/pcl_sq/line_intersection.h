// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq {

/** \brief The piece of a line inside a body: from origin + enter * direction to
 * origin + leave * direction. */
struct LineInterval {
  double enter = 0.0;
  double leave = 0.0;
};

/** \brief Where a line runs through a superquadric, to rounding.
 *
 * The gauge along a line is convex, so that Newton's method from outside of the
 * bounding box approaches each end from one side and a change of the slope's sign
 * before the surface proves a miss. A tapered body need not be convex: the interval is
 * the piece around the deepest point of the line. A body with a rim is taken to be
 * filled up to there.
 * \param[in] direction need not be of unit length; the interval counts in its lengths
 * \param[out] interval untouched on a miss \return whether the line meets the body */
[[nodiscard]] PCL_SQ_EXPORTS bool intersectLine(const Superquadric& superquadric,
                                                const Eigen::Vector3d& origin,
                                                const Eigen::Vector3d& direction,
                                                LineInterval& interval);

/** \brief Whether a line from its origin on meets the body of intersectLine(): cheaper
 * than where. */
[[nodiscard]] PCL_SQ_EXPORTS bool meetsRay(const Superquadric& superquadric,
                                           const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction);

/** \brief Where a line from its origin on first meets the material of a superquadric:
 * through the opening of a hollow body its inside or floor.
 * \param[out] at in lengths of the direction, not negative; untouched on a miss
 * \return whether it does; a line may enter a hollow and leave it over the rim */
[[nodiscard]] PCL_SQ_EXPORTS bool firstHit(const Superquadric& superquadric,
                                           const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction,
                                           double& at);

/** \brief The slab of a line inside the box around a superquadric in its own axes:
 * contains the interval of intersectLine(), without a single power. */
[[nodiscard]] PCL_SQ_EXPORTS bool intersectLineBox(const Superquadric& superquadric,
                                                   const Eigen::Vector3d& origin,
                                                   const Eigen::Vector3d& direction,
                                                   LineInterval& interval);

} // namespace pcl_sq
