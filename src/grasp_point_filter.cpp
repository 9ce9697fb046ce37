// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/grasp_point_filter.hpp"

#include "instantiate.h"

#include <limits>

namespace pcl_sq {

bool isOnSurface(const MultiSuperquadric& model,
                 const Eigen::Vector3d& point,
                 SurfaceMetric metric,
                 double tolerance) {
  if (metric == SurfaceMetric::GAUGE)
    return std::abs(model.gauge(point) - 1.0) <= tolerance;
  double distance = std::numeric_limits<double>::infinity();
  for (const Superquadric& part : model.parts)
    distance = std::min(distance, part.firstOrderDistance(point));
  return std::abs(distance) <= tolerance;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(GraspPointFilter)
