// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/sides.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

/** \brief A prism whose section is |x/a|^(2/e2) + |y/b|^(2/e2) <= 1. */
Superquadric prismOf(double a, double b, double e2) {
  Superquadric s;
  s.semi_axes = {a, b, 0.1};
  s.epsilon1 = Superquadric::MIN_EPSILON;
  s.epsilon2 = e2;
  return s;
}

} // namespace

TEST(Sides, AreTwiceTheSemiAxesUpToARoundSection) {
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon2 = random.uniform(0.05, 1.0);
    EXPECT_LT((sidesOf(s) - 2.0 * s.semi_axes).norm(), 1e-12);
  }
}

TEST(Sides, OfADiamondAreThoseOfTheSquareThatItIs) {
  const Eigen::Vector3d sides = sidesOf(prismOf(0.179, 0.179, 2.0));
  EXPECT_NEAR(sides.x(), std::sqrt(2.0) * 0.179, 2e-7);
  EXPECT_NEAR(sides.y(), std::sqrt(2.0) * 0.179, 2e-7);
  EXPECT_NEAR(sides.z(), 0.2, 1e-12);
}

TEST(Sides, OfADiamondKeepItsVolume) {
  // a prism and the box around it: all but the rounding of its ends
  const Superquadric s = prismOf(0.05, 0.05, 2.0);
  EXPECT_NEAR(sidesOf(s).prod() / s.volume(), 1.0, 0.01);
}

TEST(Sides, NearlyADiamondAreNearlyThoseOfTheFace) {
  // the case that misled: 358 x 346 for a face of 253 x 245
  const Eigen::Vector3d sides = sidesOf(prismOf(0.179, 0.173, 1.95));
  EXPECT_NEAR(sides.head<2>().maxCoeff(), 0.25, 0.012);
  EXPECT_NEAR(sides.head<2>().minCoeff(), 0.25, 0.012);
}

TEST(Sides, NeverExceedTheSemiAxesBoxAndHoldTheBody) {
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon2 = random.uniform(1.0, 2.0);
    const OrientedBox box = boxAround(s);
    EXPECT_LE(8.0 * box.half_sizes.prod(), 8.0 * s.semi_axes.prod() * (1.0 + 1e-9));
    EXPECT_GE(8.0 * box.half_sizes.prod(), s.volume());
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d p =
          s.radialProjection(s.center + Eigen::Vector3d(random.uniform(-1.0, 1.0),
                                                        random.uniform(-1.0, 1.0),
                                                        random.uniform(-1.0, 1.0)));
      EXPECT_TRUE(box.contains(p, 1e-9 * s.semi_axes.maxCoeff()));
    }
  }
}

TEST(Sides, AreContinuousWhereTheSectionIsRound) {
  for (const double b : {0.05, 0.07})
    EXPECT_LT(
        (sidesOf(prismOf(0.05, b, 1.0)) - sidesOf(prismOf(0.05, b, 1.001))).norm(),
        1e-3 * b);
}

TEST(Sides, OfAUnionDoNotDependOnItsPose) {
  Random random(13);
  MultiSuperquadric model;
  for (int k = 0; k < 2; ++k) {
    Superquadric part;
    part.semi_axes = {0.03 + 0.01 * k, 0.02, 0.05};
    part.epsilon1 = part.epsilon2 = 0.3;
    part.center = {0.01 * k, 0.0, 0.08 * k};
    part.kx = 0.2 * k;
    model.parts.push_back(part);
  }
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const OrientedBox box = boxAround(model, up);
  EXPECT_NEAR(2.0 * box.half_sizes.z(), 0.18, 1e-9);
  EXPECT_GE(box.half_sizes.x(), box.half_sizes.y());
  for (int i = 0; i < 10; ++i) {
    const Superquadric pose = random.superquadric();
    MultiSuperquadric moved = model;
    for (Superquadric& part : moved.parts) {
      part.center = pose.rotation * part.center + pose.center;
      part.rotation = pose.rotation * part.rotation;
    }
    const OrientedBox other = boxAround(moved, Eigen::Vector3d(pose.rotation * up));
    EXPECT_LT((other.half_sizes - box.half_sizes).norm(), 1e-5);
    const OrientedBox free = boxAround(moved);
    EXPECT_LE(free.half_sizes.prod(), box.half_sizes.prod() * (1.0 + 1e-6));
  }
}

TEST(Sides, OfNothingAreZero) {
  EXPECT_EQ(boxAround(MultiSuperquadric()).half_sizes.norm(), 0.0);
}
