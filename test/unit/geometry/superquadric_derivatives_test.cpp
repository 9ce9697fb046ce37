// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of the superquadric against central differences.
#include "pcl_sq/superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using pcl_sq::Superquadric;
using pcl_sq::SuperquadricCoefficients;
using namespace pcl_sq::test;

namespace {} // namespace

TEST(Superquadric, GradientsMatchCentralDifferences) {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d p = random.pointNear(s);
    const double h = 1e-7 * s.semi_axes.minCoeff();
    Eigen::Vector3d numeric_g, numeric_f;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
      numeric_g[k] = (s.gauge(p + d) - s.gauge(p - d)) / (2 * h);
      numeric_f[k] =
          (std::log(s.insideOutside(p + d)) - std::log(s.insideOutside(p - d))) /
          (2 * h);
    }
    const Eigen::Vector3d g = s.gaugeGradient(p);
    EXPECT_LT((g - numeric_g).norm(), 1e-4 * g.norm());
    const double f = s.insideOutside(p);
    if (f > 1e-200 && f < 1e200) {
      const Eigen::Vector3d df = s.insideOutsideGradient(p) / f;
      EXPECT_LT((df - numeric_f).norm(), 1e-4 * df.norm());
    }
  }
}

TEST(Superquadric, LogGaugeJacobianMatchesCentralDifferences) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.06, 1.99);
    s.epsilon2 = random.uniform(0.06, 1.99);
    const Eigen::Vector3d p = random.pointNear(s);
    const SuperquadricCoefficients jacobian = s.logGaugeJacobian(p);
    for (int k = 0; k < 11; ++k) {
      const double h = k < 3 ? 1e-7 * s.semi_axes.minCoeff() : 1e-7;
      const double numeric =
          (std::log(moved(s, k, h).gauge(p)) - std::log(moved(s, k, -h).gauge(p))) /
          (2 * h);
      const double scale = k < 3   ? jacobian.head<3>().norm()
                           : k < 6 ? jacobian.segment<3>(3).norm()
                                   : 1.0;
      EXPECT_NEAR(jacobian[k], numeric, 2e-5 * (scale + 1.0)) << "parameter " << k;
    }
  }
}

TEST(Superquadric, SupportJacobianMatchesCentralDifferences) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.06, 1.95);
    s.epsilon2 = random.uniform(0.06, 1.95);
    const Eigen::Vector3d n = random.direction();
    const SuperquadricCoefficients jacobian = s.supportJacobian(n);
    for (int k = 0; k < 11; ++k) {
      const double h = 1e-6;
      const Superquadric a = moved(s, k, h), b = moved(s, k, -h);
      const double numeric =
          (n.dot(a.center) + a.support(n) - n.dot(b.center) - b.support(n)) / (2 * h);
      EXPECT_NEAR(jacobian[k], numeric, 1e-5 * s.semi_axes.maxCoeff() + 1e-9)
          << "parameter " << k;
    }
  }
}
