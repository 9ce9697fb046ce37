// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/kernels.h"
#include "pcl_sq/multi_superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Both at once, in one pass with the vectorised kernels; non-finite points are
 * left out. Zeros for no points or an empty model.
 * \param[in] points Eigen::Ref<const Eigen::Matrix3Xd> or CloudPoints */
template <typename Points>
SurfaceStatistics surfaceStatistics(const MultiSuperquadric& model,
                                    const Points& points);

/** \brief The smallest signed residual of all parts for each point: where a point lies
 * in the union. Distances are in metres; infinity for an empty model. \param[in] points
 * finite */
std::vector<double> smallestResiduals(const MultiSuperquadric& model,
                                      const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                      kernels::Residual residual);

} // namespace pcl_sq::detail
