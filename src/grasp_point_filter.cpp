// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/grasp_point_filter.hpp"

#include "instantiate.h"
#include "surface_statistics.h"

#include <cmath>

namespace pcl_sq {

std::vector<bool> onSurface(const MultiSuperquadric& model,
                            const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                            SurfaceMetric metric,
                            double tolerance) {
  const std::vector<double> residuals = detail::smallestResiduals(
      model,
      points,
      metric == SurfaceMetric::GAUGE ? kernels::Residual::GAUGE
                                     : kernels::Residual::FIRST_ORDER);
  std::vector<bool> hits(residuals.size());
  for (std::size_t i = 0; i < residuals.size(); ++i)
    hits[i] = std::abs(residuals[i]) <= tolerance;
  return hits;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(GraspPointFilter)
