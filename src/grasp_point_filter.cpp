// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/grasp_point_filter.hpp"

#include "instantiate.h"
#include "surface_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

double surfaceNoise(const MultiSuperquadric& model,
                    const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  Eigen::Matrix3Xd finite(3, points.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      finite.col(count++) = points.col(i);
  if (count == 0 || model.empty())
    return 0.0;
  std::vector<double> distances = detail::smallestResiduals(
      model, finite.leftCols(count), kernels::Residual::FIRST_ORDER);
  for (double& d : distances)
    d = std::abs(d);
  const auto middle =
      distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return 1.4826 * *middle; // of a normal distribution
}

PointGrasp describeGraspPoint(const MultiSuperquadric& model,
                              const Eigen::Vector3d& point) {
  std::size_t nearest = 0;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < model.size(); ++k) {
    const double d = model.parts[k].firstOrderDistance(point);
    if (d < distance) {
      distance = d;
      nearest = k;
    }
  }
  PointGrasp result;
  result.getVector3fMap() = point.cast<float>();
  result.getNormalVector3fMap() = model.parts[nearest].normal(point).cast<float>();
  result.residual = static_cast<float>(distance);
  result.part = static_cast<std::uint32_t>(nearest);
  return result;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(GraspPointFilter)
