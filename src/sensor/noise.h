// SPDX-License-Identifier: BSD-3-Clause
// Private. How far measured points err, and how many of them err alike.
#pragma once

#include "sensor/depth_patch.h"

namespace pcl_sq::detail {

/** \brief How far each point's surface moves along its normal when the measurement
 * belongs a pixel beside the point's own [m]. */
Eigen::VectorXf lateralNoise(const Observation& o, const DepthPatch& patch);

/** \brief How many points share one error: 1 where neighbours err independently. */
double sharingOfErrors(const Eigen::Matrix3Xd& points);

/** \brief Pixels of a mask's outline that err alike: hands, nets and graph cuts smooth
 * over about as many. */
constexpr double OUTLINE_CORRELATION = 7.0;

} // namespace pcl_sq::detail
