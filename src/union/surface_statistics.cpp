// SPDX-License-Identifier: BSD-3-Clause
#include "union/surface_statistics.h"

#include "geometry/taper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_sq::detail {

namespace {

constexpr Eigen::Index CHUNK = 4096; ///< points at a time: bounds the memory

/** \brief The model's own frame: its box around the origin, of size about one. */
Normalisation frameOf(const MultiSuperquadric& model) {
  const Eigen::AlignedBox3d box = model.boundingBox();
  Normalisation frame;
  frame.origin = box.center();
  frame.scale = 0.5 * box.sizes().maxCoeff();
  return frame;
}

/** \brief Replaces each value by the entry of smaller size among all parts. */
void keepNearest(const std::vector<float>& candidate, std::vector<float>& nearest) {
  for (std::size_t i = 0; i < nearest.size(); ++i)
    if (std::abs(candidate[i]) < std::abs(nearest[i]))
      nearest[i] = candidate[i];
}

} // namespace

template <typename Points>
SurfaceStatistics surfaceStatistics(const MultiSuperquadric& model,
                                    const Points& points) {
  SurfaceStatistics statistics;
  if (model.empty())
    return statistics;
  const Normalisation frame = frameOf(model);
  std::vector<Superquadric> bodies;
  std::vector<double> factors; // sqrt(a1 a2 a3), Eq. (7)
  for (const Superquadric& part : model.parts) {
    bodies.push_back(frame.toUnit(part));
    factors.push_back(std::sqrt(part.semi_axes.prod()));
  }
  std::vector<float> relative, nearest, metric, nearest_metric;
  std::vector<double> nearest_factor;
  double distortion = 0.0, squares = 0.0;
  std::size_t count = 0;
  for (Eigen::Index first = 0; first < points.cols(); first += CHUNK) {
    const UnitPoints chunk =
        toUnit(Points(points.middleCols(first, std::min(CHUNK, points.cols() - first))),
               frame);
    const std::size_t n = chunk.size();
    relative.resize(n + kernels::BLOCK);
    metric.resize(n + kernels::BLOCK);
    nearest.assign(n, std::numeric_limits<float>::infinity());
    nearest_metric.assign(n, std::numeric_limits<float>::infinity());
    nearest_factor.assign(n, 0.0);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      residualsOf(bodies[k], chunk, kernels::Residual::GAUGE, relative.data());
      for (std::size_t i = 0; i < n; ++i)
        if (std::abs(relative[i]) < std::abs(nearest[i])) {
          nearest[i] = relative[i];
          nearest_factor[i] = factors[k];
        }
      if (bodies[k].isCut()) { // a distance already, see openResiduals()
        const float size = static_cast<float>(std::cbrt(bodies[k].semi_axes.prod()));
        std::transform(relative.begin(),
                       relative.end(),
                       metric.begin(),
                       [size](float r) { return r * size; });
      } else
        residualsOf(bodies[k], chunk, kernels::Residual::FOOT_POINT, metric.data());
      keepNearest(metric, nearest_metric);
    }
    for (std::size_t i = 0; i < n; ++i) {
      distortion += nearest_factor[i] * double(nearest[i]) * double(nearest[i]);
      squares += double(nearest_metric[i]) * double(nearest_metric[i]);
    }
    count += n;
  }
  if (count > 0) {
    statistics.distortion = distortion / double(count);
    statistics.rms_distance = frame.scale * std::sqrt(squares / double(count));
  }
  return statistics;
}

template SurfaceStatistics surfaceStatistics(const MultiSuperquadric&,
                                             const Eigen::Ref<const Eigen::Matrix3Xd>&);
template SurfaceStatistics surfaceStatistics(const MultiSuperquadric&,
                                             const CloudPoints&);

std::vector<double> smallestResiduals(const MultiSuperquadric& model,
                                      const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                      kernels::Residual residual) {
  std::vector<double> smallest(points.cols(), std::numeric_limits<double>::infinity());
  if (model.empty())
    return smallest;
  const Normalisation frame = frameOf(model);
  const bool metric =
      residual != kernels::Residual::GAUGE && residual != kernels::Residual::SOLINA;
  const double unit = metric ? frame.scale : 1.0;
  const UnitPoints unit_points = toUnit(points, frame);
  std::vector<float> values(unit_points.size() + kernels::BLOCK);
  for (const Superquadric& part : model.parts) {
    residualsOf(frame.toUnit(part), unit_points, residual, values.data());
    for (std::size_t i = 0; i < unit_points.size(); ++i)
      smallest[i] = std::min(smallest[i], unit * double(values[i]));
  }
  return smallest;
}

} // namespace pcl_sq::detail
