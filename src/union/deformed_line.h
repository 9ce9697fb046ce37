// SPDX-License-Identifier: BSD-3-Clause
// Private. Lines through tapered and bent bodies, along which the gauge may have
// several minima.
#pragma once

#include "pcl_sq/line_intersection.h"

namespace pcl_sq::detail {

/** \brief At how many places a line is looked at: often enough to meet a thin bent rod.
 */
int samplesAlong(const Superquadric& s);

/** \brief Where a line comes deepest into a tapered or bent body, between two places;
 * the gauge may have several minima along a line. */
double deepest(const Superquadric& s,
               const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction,
               const LineInterval& range,
               double& gauge);

/** \brief The surface between a place inside of a tapered or bent body and one
 * outside: the first one, where a line leaves a bent body and enters it again. */
double crossing(const Superquadric& s,
                const Eigen::Vector3d& origin,
                const Eigen::Vector3d& direction,
                double inside,
                double outside);

} // namespace pcl_sq::detail
