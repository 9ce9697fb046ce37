// SPDX-License-Identifier: BSD-3-Clause
// The meridian of an open vessel and its derivatives.
#include "families/vessel_profile.h"

#include <gtest/gtest.h>

#include <random>

using namespace pcl_sq;
using namespace pcl_sq::detail;

namespace {

/** \brief A vessel with one of its parameters moved: ln a, ln a3, e1, k, rim, ln wall.
 */
Superquadric nudged(Superquadric s, int i, double step) {
  if (i == 0)
    s.semi_axes.head<2>() *= std::exp(step);
  if (i == 1)
    s.semi_axes.z() *= std::exp(step);
  if (i == 2)
    s.epsilon1 += step;
  if (i == 3)
    s.kx = s.ky = s.kx + step;
  if (i == 4)
    s.rim += step;
  if (i == 5)
    s.wall *= std::exp(step);
  return s;
}

} // namespace

TEST(VesselProfile, DerivativesAreThoseOfDifferences) {
  std::mt19937 engine(11);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int trial = 0; trial < 200; ++trial) {
    Superquadric s;
    s.semi_axes.setConstant(uniform(0.5, 1.5));
    s.semi_axes.z() = uniform(0.3, 2.0);
    s.epsilon1 = uniform(0.1, 1.4);
    s.kx = s.ky = uniform(-0.4, 0.4);
    s.rim = uniform(-0.5, 0.95);
    s.wall = uniform(0.02, 0.1);
    const VesselProfile here(s);
    const auto check = [&](const auto& line, const auto& low, const auto& high, int k) {
      constexpr double STEP = 1e-6;
      for (std::size_t i = 0; i < line.size(); ++i) {
        if (std::abs(line[i].at.y()) < 0.05 * s.semi_axes.z())
          continue; // at the equator heights move without bounds
        const Eigen::Vector2d slope = (high[i].at - low[i].at) / (2.0 * STEP);
        EXPECT_LT((line[i].d.col(k) - slope).norm(), 1e-4 * (1.0 + slope.norm()))
            << trial << " parameter " << k << " vertex " << i;
      }
    };
    for (int k = 0; k < 6; ++k) {
      const VesselProfile low(nudged(s, k, -1e-6)), high(nudged(s, k, 1e-6));
      check(here.outside, low.outside, high.outside, k);
      check(here.inside, low.inside, high.inside, k);
    }
  }
}
