// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/grasp_point_filter.hpp"

#include "union/surface_statistics.h"

#include <pcl/point_types.h>

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

namespace detail {

void selectOnSurface(const MultiSuperquadric& model,
                     const CoordinateMap& points,
                     const pcl::Indices& indices,
                     SurfaceMetric metric,
                     double tolerance,
                     pcl::Indices& on_surface,
                     pcl::Indices& others) {
  on_surface.clear();
  others.clear();
  constexpr Eigen::Index CHUNK = 4096; // points tested at a time
  Eigen::Matrix3Xd chunk(3, CHUNK);
  pcl::Indices tested;
  const auto testChunk = [&] {
    const auto n = static_cast<Eigen::Index>(tested.size());
    const std::vector<bool> hits =
        onSurface(model, chunk.leftCols(n), metric, tolerance);
    for (std::size_t i = 0; i < tested.size(); ++i)
      (hits[i] ? on_surface : others).push_back(tested[i]);
    tested.clear();
  };
  for (const auto index : indices) {
    const auto point = points.col(index);
    if (!point.allFinite())
      continue;
    chunk.col(static_cast<Eigen::Index>(tested.size())) = point.cast<double>();
    tested.push_back(index);
    if (static_cast<Eigen::Index>(tested.size()) == CHUNK)
      testChunk();
  }
  testChunk();
}

double surfaceNoise(const MultiSuperquadric& model,
                    const CoordinateMap& points,
                    const pcl::Indices& indices) {
  Eigen::Matrix3Xd chosen(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    chosen.col(static_cast<Eigen::Index>(i)) = points.col(indices[i]).cast<double>();
  return pcl_sq::surfaceNoise(model, chosen);
}

} // namespace detail

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(template class, GraspPointFilter)
