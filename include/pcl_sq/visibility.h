// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq {

/** \brief Whether a union hides a point of its surface from an eye: the line of sight
 * enters a part before it comes to the point. So a part's far side, what another part
 * covers, and what lies inside of another part are hidden.
 * \param[in] point on or in the union, \a eye outside, both in the cloud's frame [m]
 * \param[in] slack the line may be inside of a part this long before the point [m];
 * keeps points of the near side visible in spite of rounding */
[[nodiscard]] PCL_SQ_EXPORTS bool isHidden(const MultiSuperquadric& model,
                                           const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& eye,
                                           double slack);

} // namespace pcl_sq
