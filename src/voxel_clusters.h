// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_sq::detail {

/** \brief The largest set of points connected through touching voxels of side \a gap.
 *
 * Linear in the points, where a search by radius is quadratic in their density.
 * \param[in] columns points to consider, finite
 * \return their columns in the order of \a columns */
std::vector<int> largestCluster(const Eigen::Matrix3Xf& points,
                                const std::vector<int>& columns,
                                double gap);

} // namespace pcl_sq::detail
