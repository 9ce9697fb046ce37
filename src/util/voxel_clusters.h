// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief The sets of points that are connected through touching voxels of side \a
 * gap, the largest first.
 *
 * Linear in the points, where a search by radius is quadratic in their density.
 * \param[in] columns points to consider, finite
 * \return the columns of each set in the order of \a columns */
std::vector<std::vector<int>>
clustersOf(const CloudPoints& points, const std::vector<int>& columns, double gap);

} // namespace pcl_sq::detail
