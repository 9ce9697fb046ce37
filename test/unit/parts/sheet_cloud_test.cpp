// SPDX-License-Identifier: BSD-3-Clause
// Clouds from all round of things of sheet: pans and dishes, and what is a view.
#include "fit_scene.h"
#include "observe_points.h"

#include "observe/sheets.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A pan as a shallow box of sheet: both sides of its bottom and walls. */
Eigen::Matrix3Xd pan() {
  Random random(5);
  Eigen::Matrix3Xd points(3, 3000);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double radius = 0.12 * std::sqrt(random.uniform(0.0, 1.0));
    const double turn = random.uniform(0.0, 6.283);
    points.col(i) << radius * std::cos(turn), radius * std::sin(turn),
        0.03 * std::pow(radius / 0.12, 4) + (i % 2 == 0 ? 0.0 : 0.004);
  }
  return points;
}

/** \brief A dish: the lower part of a hollow ball, open above. */
Eigen::Matrix3Xd dish(int count, double wall, unsigned seed) {
  constexpr double RADIUS = 0.085, HEIGHT = 0.06;
  Random random(seed);
  Eigen::Matrix3Xd points(3, count);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double inset = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : wall;
    const double radius = RADIUS - inset;
    const double z =
        random.uniform(inset, HEIGHT) - RADIUS; // a ball's area is even in z
    const double across = std::sqrt(radius * radius - z * z);
    const double turn = random.uniform(0.0, 6.283);
    points.col(i) << across * std::cos(turn), across * std::sin(turn), z;
  }
  return points;
}

} // namespace

TEST(WholeCloud, NoPartLeavesTheBoxOfThePoints) {
  const Eigen::Matrix3Xd points = pan();
  const ObjectFit fit = fitObject(observe(points, Coverage::COMPLETE));
  const Eigen::Vector3d low = points.rowwise().minCoeff(),
                        high = points.rowwise().maxCoeff();
  const double slack = 0.05 * (high - low).maxCoeff();
  ASSERT_FALSE(fit.model.empty());
  for (const Superquadric& part : fit.model.parts) {
    EXPECT_LT((part.boundingBox().max() - high).maxCoeff(), slack);
    EXPECT_LT((low - part.boundingBox().min()).maxCoeff(), slack);
  }
}

TEST(WholeCloud, ADishFromAllRoundIsOneOpenVesselInEverySampling) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const MultiSuperquadric model =
        fitObject(observe(dish(5000, 0.004, seed), Coverage::COMPLETE)).model;
    ASSERT_EQ(model.size(), 1u);
    EXPECT_NEAR(model.parts[0].wall, 0.004, 0.001);
    EXPECT_NEAR(model.boundingBox().sizes().minCoeff(), 0.06, 0.006);
  }
}

TEST(WholeCloud, WallsShowInDenseCloudsToo) {
  const auto shows = [](const Eigen::Matrix3Xd& points) {
    return detail::surfaceOf(points).two_sided;
  };
  EXPECT_TRUE(shows(dish(5000, 0.004, 1)));
  EXPECT_TRUE(shows(dish(60000, 0.004, 1)));
  EXPECT_FALSE(shows(dish(5000, 0.0, 1)));
  EXPECT_FALSE(shows(dish(60000, 0.0, 1)));
}

TEST(Coverage, APanFromAllRoundIsNoViewUnlessTheUserSaysSo) {
  const Eigen::Matrix3Xd points = pan();
  EXPECT_TRUE(detail::surfaceOf(points).two_sided);
  EXPECT_FALSE(observe(points, Coverage::AUTOMATIC).hasCamera());
  EXPECT_TRUE(observe(points, Coverage::ONE_SIDED).hasCamera());
}

TEST(Coverage, HalfABallIsAViewUnlessTheUserSaysItIsComplete) {
  Random random(6);
  Eigen::Matrix3Xd points(3, 2000);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    p.normalize();
    p.z() = std::abs(p.z());
    points.col(i) = (0.1 + 0.001 * random.normal()) * p;
  }
  EXPECT_FALSE(detail::surfaceOf(points).two_sided);
  EXPECT_TRUE(observe(points, Coverage::AUTOMATIC).hasCamera());
  EXPECT_FALSE(observe(points, Coverage::COMPLETE).hasCamera());
}
