// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/taper.h"
#include "pcl_sq/fit_superquadric.h"
#include "util/point_set.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace pcl_sq {

namespace {

constexpr Eigen::Index CHUNK = 4096; ///< points at a time: bounds the memory
constexpr float FAR = 1e6F; ///< in sizes; keeps squares within single precision

template <typename Points>
Eigen::VectorXd distancesTo(const Superquadric& superquadric, const Points& points) {
  detail::Normalisation frame;
  frame.origin = superquadric.center;
  frame.scale = superquadric.semi_axes.maxCoeff();
  const double per_unit = 1.0 / frame.scale;
  const Superquadric body = frame.toUnit(superquadric);
  detail::UnitPoints unit;
  unit.reserve(static_cast<std::size_t>(std::min(CHUNK, points.cols())));
  std::vector<float> residuals(CHUNK);
  Eigen::VectorXd distances(points.cols());
  for (Eigen::Index first = 0; first < points.cols(); first += CHUNK) {
    const Eigen::Index count = std::min(CHUNK, points.cols() - first);
    unit.clear();
    for (Eigen::Index i = first; i < first + count; ++i) {
      const Eigen::Vector3d p =
          per_unit * (points.col(i).template cast<double>() - frame.origin);
      const bool finite = (p[0] + p[1] + p[2]) * 0.0 == 0.0;
      distances[i] = finite ? 0.0 : std::numeric_limits<double>::infinity();
      const Eigen::Vector3f f =
          (finite ? p : Eigen::Vector3d(0.0, 0.0, 0.0)).cast<float>();
      unit.add(std::clamp(f[0], -FAR, FAR),
               std::clamp(f[1], -FAR, FAR),
               std::clamp(f[2], -FAR, FAR));
    }
    detail::residualsOf(body, unit, kernels::Residual::FOOT_POINT, residuals.data());
    for (Eigen::Index i = 0; i < count; ++i)
      distances[first + i] +=
          frame.scale * double(residuals[static_cast<std::size_t>(i)]);
  }
  return distances;
}

} // namespace

Eigen::VectorXd surfaceDistances(const Superquadric& superquadric,
                                 const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  return distancesTo(superquadric, points);
}

Eigen::VectorXd surfaceDistances(const Superquadric& superquadric,
                                 const CloudPoints& points) {
  return distancesTo(superquadric, points);
}

bool spansVolume(const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  return detail::spannedDimensions(points) == 3;
}

bool spansVolume(const CloudPoints& points) {
  return detail::spannedDimensions(points) == 3;
}

} // namespace pcl_sq
