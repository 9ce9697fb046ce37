// SPDX-License-Identifier: BSD-3-Clause
#include "fit/density_filter.h"
#include "fit/full_fit.h"

#include <algorithm>
#include <cstdint>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t POINTS = 512;
constexpr double EXACT = 1e-5;      ///< a sigma that only the right shape has
constexpr double SYSTEMATIC = 0.35; ///< a correlation that noise never has
constexpr double MANY_OUTLIERS = 0.03;
constexpr double MANY = 0.4;     ///< outliers: with fewer no wrong fit was ever seen
constexpr double CROWDED = 0.75; ///< of the outliers' share

/** \brief The ten low bits of a number, two zeros after each. */
std::uint32_t spreadBits(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  return (x | (x << 2)) & 0x09249249;
}

/** \brief Position on Morton's curve through the box [-4, 4]^3. */
std::uint32_t mortonCode(const Eigen::Vector3f& p) {
  std::uint32_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const float cell = std::clamp((p[k] + 4.0F) * 128.0F, 0.0F, 1023.0F);
    code |= spreadBits(static_cast<std::uint32_t>(cell)) << k;
  }
  return code;
}

std::vector<float> residualsOf(const UnitPoints& points, const Superquadric& model) {
  std::vector<float> residuals(points.size());
  kernels::kernels().residuals(
      points.view(), toShape(model), kernels::Residual::FOOT_POINT, residuals.data());
  return residuals;
}

/** \brief How alike the residuals of neighbouring inliers are, -1 to 1: about zero for
 * noise, near one where the shape is wrong (von Neumann's ratio along Morton's curve).
 */
double residualCorrelation(const UnitPoints& points, const Candidate& c) {
  const UnitPoints few = subset(points, POINTS);
  const std::vector<float> residuals = residualsOf(few, c.model);
  std::vector<std::pair<std::uint32_t, float>> ordered;
  const auto outlying = static_cast<float>(3.0 * c.mixture.sigma);
  for (std::size_t i = 0; i < few.size(); ++i)
    if (std::abs(residuals[i]) <= outlying)
      ordered.emplace_back(mortonCode(few[i]), residuals[i]);
  std::sort(ordered.begin(), ordered.end());
  double squares = 0.0, products = 0.0;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    squares += double(ordered[i].second) * ordered[i].second;
    if (i > 0)
      products += double(ordered[i].second) * ordered[i - 1].second;
  }
  return squares > 0.0 ? products / squares : 0.0;
}

/** \brief Whether the supposed outliers are as crowded as the inliers, and so rather a
 * part of the surface that the model misses. */
bool outliersCrowded(const UnitPoints& points, const Candidate& c) {
  if (c.mixture.outlier_share < MANY_OUTLIERS)
    return false;
  const UnitPoints dense = densePoints(points);
  const std::vector<float> residuals = residualsOf(dense, c.model);
  const auto outlying = static_cast<float>(4.0 * c.mixture.sigma);
  const auto count =
      std::count_if(residuals.begin(), residuals.end(), [outlying](float r) {
        return std::abs(r) > outlying;
      });
  return double(count) > CROWDED * c.mixture.outlier_share * double(residuals.size());
}

} // namespace

bool doubtful(const UnitPoints& points, const Candidate& c) {
  return c.mixture.sigma > EXACT &&
         (c.mixture.outlier_share > MANY || outliersCrowded(points, c) ||
          residualCorrelation(points, c) > SYSTEMATIC);
}

} // namespace pcl_sq::detail
