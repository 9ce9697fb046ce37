// SPDX-License-Identifier: BSD-3-Clause
#include "scene/noise.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::app {
namespace {

std::uint64_t
cellKey(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  return seed ^ (static_cast<std::uint64_t>(x) * 0x8da6b343ull) ^
         (static_cast<std::uint64_t>(y) * 0xd8163841ull << 11) ^
         (static_cast<std::uint64_t>(z) * 0xcb1ab31full << 23);
}

double latticeNoise(const Eigen::Vector3d& p, std::uint64_t seed) {
  const Eigen::Vector3d base = p.array().floor();
  const Eigen::Vector3d f = p - base;
  const Eigen::Vector3d s = f.array().square() * (3.0 - 2.0 * f.array());
  const auto x = static_cast<std::int64_t>(base.x());
  const auto y = static_cast<std::int64_t>(base.y());
  const auto z = static_cast<std::int64_t>(base.z());
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight =
        (i ? s.x() : 1 - s.x()) * (j ? s.y() : 1 - s.y()) * (k ? s.z() : 1 - s.z());
    sum += weight * (2.0 * uniformOf(cellKey(x + i, y + j, z + k, seed)) - 1.0);
  }
  return sum;
}

} // namespace

double normalOf(std::uint64_t key) {
  constexpr double TWO_PI = 6.28318530717958647692;
  const double u = 1.0 - uniformOf(2 * key); // in (0, 1]
  return std::sqrt(-2.0 * std::log(u)) * std::cos(TWO_PI * uniformOf(2 * key + 1));
}

double solidNoise(const Eigen::Vector3d& p,
                  double coarse,
                  double fine,
                  double footprint,
                  std::uint64_t seed) {
  double sum = 0.0, power = 0.0, amplitude = 1.0;
  double wave = coarse;
  while (wave >= fine) {
    power += amplitude * amplitude;
    const double share = std::clamp(wave / (2.0 * footprint) - 1.0, 0.0, 1.0);
    if (share > 0.0)
      sum += amplitude * share * latticeNoise(p / wave, ++seed);
    amplitude *= 0.85;
    wave *= 0.5;
  }
  return 1.8 * sum / std::sqrt(power);
}

} // namespace pcl_sq::app
