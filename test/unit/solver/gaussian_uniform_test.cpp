// SPDX-License-Identifier: BSD-3-Clause
// The volume that noise around a surface fills, and what follows for fits.
#include "bottle_view.h"

#include "pcl_sq/fit_superquadric.h"
#include "solver/gaussian_uniform.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::detail;
using namespace pcl_sq::test;

namespace {

constexpr double PI = 3.14159265358979323846;

/** \brief Integral of exp(-d^2 / 2 sigma^2) over the space around a sphere, by the
 * midpoint rule. */
double filledBySphere(double radius, double sigma) {
  constexpr int STEPS = 20000;
  const double end = radius + 10.0 * sigma;
  double sum = 0.0;
  for (int i = 0; i < STEPS; ++i) {
    const double r = end * (i + 0.5) / STEPS;
    const double d = (r - radius) / sigma;
    sum += 4.0 * PI * r * r * std::exp(-0.5 * d * d) * end / STEPS;
  }
  return sum;
}

} // namespace

TEST(Mixture, KnowsTheVolumeThatNoiseAroundASphereFills) {
  for (const double sigma : {0.01, 0.1, 0.25}) {
    Mixture mixture;
    mixture.sigma = sigma;
    const double filled = mixture.filledArea(4.0 * PI) * std::sqrt(2.0 * PI) * sigma;
    EXPECT_NEAR(filled / filledBySphere(1.0, sigma), 1.0, 1e-4) << sigma;
  }
}

TEST(Mixture, ASpeckFillsNoLessThanHalfOfItsNoise) {
  // all of the noise of a point lies outside it: twice what is there, and never nothing
  Mixture mixture;
  mixture.sigma = 1.0;
  const double filled = mixture.filledArea(0.0) * std::sqrt(2.0 * PI);
  EXPECT_NEAR(filled / filledBySphere(0.0, 1.0), 2.0, 1e-3);
}

TEST(Mixture, SizesPriorHasTheGradientOfItsCost) {
  Superquadric body;
  body.semi_axes = {0.3, 0.2, 0.4};
  body.epsilon1 = 0.6;
  body.epsilon2 = 0.9;
  for (const double sigma : {0.01, 0.3, 3.0}) {
    const Contributor prior = sizePrior(sigma, 100.0);
    NormalEquations at;
    prior(body, at);
    for (int k = 0; k < 3; ++k) {
      constexpr double STEP = 1e-4; // of the semi-axis' logarithm
      double cost[2];
      for (const int side : {0, 1}) {
        Superquadric other = body;
        other.semi_axes[k] *= std::exp(side ? STEP : -STEP);
        NormalEquations there;
        prior(other, there);
        cost[side] = there.cost;
      }
      // the normal equations hold half of the cost's gradient
      EXPECT_NEAR(0.5 * (cost[1] - cost[0]) / (2.0 * STEP),
                  at.jtr[6 + k],
                  1e-4 * std::abs(at.jtr[6 + k]))
          << sigma;
    }
  }
}

TEST(Mixture, NoSpeckExplainsABottle) {
  for (const unsigned seed : {1u, 2u, 3u, 4u})
    for (const std::size_t count : {200u, 500u, 900u}) {
      const FitSummary fit =
          fitSuperquadric(visiblePoints(bottle(), count, 0.0005, seed));
      // one body is a poor model of two, but no smaller than the neck is wide
      EXPECT_GT(2.0 * fit.model.semi_axes.maxCoeff(), 0.026) << seed << " " << count;
    }
}
