// SPDX-License-Identifier: BSD-3-Clause
#include "full_fit.h"

#include <algorithm>
#include <cstdint>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t POINTS = 512;

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

} // namespace

double residualCorrelation(const UnitPoints& points, const Candidate& c) {
  const UnitPoints few = subset(points, POINTS);
  std::vector<float> residuals(few.size());
  kernels::kernels().residuals(
      few.view(), toShape(c.model), kernels::Residual::FOOT_POINT, residuals.data());
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

} // namespace pcl_sq::detail
