// SPDX-License-Identifier: BSD-3-Clause
// Distances to the superquadric: exact ones, their order, the closest point.
#include "pcl_sq/superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using pcl_sq::Superquadric;
using namespace pcl_sq::test;

TEST(Superquadric, AStepInwardAlongTheNormalIsNoFartherFromTheSurfaceThanItIsLong) {
  Random random(61);
  for (int i = 0; i < 4000; ++i) {
    Superquadric s = random.superquadric();
    if (i % 2 == 0) // flat faces, whose feet are hard to find from within
      s.epsilon1 = s.epsilon2 = 0.1;
    const Eigen::Vector3d p = random.surfacePoint(s);
    const double step = 0.02 * random.uniform(0.0, 1.0) * s.semi_axes.minCoeff();
    EXPECT_LT(std::abs(s.euclideanDistance(p - step * s.normal(p))),
              1.001 * step + 1e-12);
  }
}

TEST(Superquadric, DistancesOfASphereAreExact) {
  Random random(8);
  Superquadric s; // the paper prints a = 2 radius for the tomato; a is the radius
  s.semi_axes.setConstant(0.04);
  s.center = {0.1, -0.2, 0.9};
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p =
        s.center + random.direction() * random.uniform(0.001, 0.2);
    const double expected = (p - s.center).norm() - 0.04;
    EXPECT_NEAR(s.radialDistance(p), expected, 1e-12);
    EXPECT_NEAR(s.firstOrderDistance(p), expected, 1e-12);
    EXPECT_NEAR(s.footPointDistance(p), expected, 1e-12);
    EXPECT_NEAR(s.euclideanDistance(p), expected, 1e-12);
  }
}

TEST(Superquadric, DistancesOutsideAreOrderedFirstOrderEuclideanFootPointRadial) {
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d p =
        s.center + (s.radialProjection(random.pointNear(s)) - s.center) *
                       random.uniform(1.01, 3.0);
    const double tolerance = 1e-9;
    const double euclidean = s.euclideanDistance(p);
    EXPECT_LE(s.firstOrderDistance(p), euclidean + tolerance);
    EXPECT_LE(euclidean, s.footPointDistance(p) + tolerance);
    EXPECT_LE(s.footPointDistance(p), s.radialDistance(p) + tolerance);
  }
}

TEST(Superquadric, ClosestPointBeatsADenseSamplingOfTheSurface) {
  Random random(10);
  for (int i = 0; i < 30; ++i) {
    const Superquadric s = random.superquadric();
    std::vector<Eigen::Vector3d> surface;
    for (int k = 0; k < 20000; ++k)
      surface.push_back(
          s.radialProjection(s.toWorld(random.direction().cwiseProduct(s.semi_axes))));
    for (int k = 0; k < 10; ++k) {
      const Eigen::Vector3d p = random.pointNear(s);
      double nearest = 1e300;
      for (const Eigen::Vector3d& q : surface)
        nearest = std::min(nearest, (p - q).norm());
      const Eigen::Vector3d c = s.closestPoint(p);
      EXPECT_NEAR(s.gauge(c), 1.0, 1e-9);
      EXPECT_LE((p - c).norm(), nearest * (1 + 1e-3) + 1e-6)
          << "e " << s.epsilon1 << " " << s.epsilon2 << " G " << s.gauge(p);
    }
  }
}
