// SPDX-License-Identifier: BSD-3-Clause
#include "union/shortest_turn.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

void expectTurn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Matrix3d turn = detail::shortestTurn(from, to);
  EXPECT_NEAR((turn * from.normalized() - to.normalized()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
  EXPECT_GT(turn.determinant(), 0.0);
  // the trace tells the angle, which is the one between the directions
  const double cosine = from.normalized().dot(to.normalized());
  EXPECT_NEAR(turn.trace(), 1.0 + 2.0 * cosine, 1e-12);
}

} // namespace

TEST(ShortestTurn, TakesAnyDirectionToAnyByTheAngleBetweenThem) {
  test::Random random(5);
  for (int i = 0; i < 100; ++i)
    expectTurn({random.normal(1), random.normal(1), random.normal(1)},
               {random.normal(3), random.normal(3), random.normal(3)});
}

TEST(ShortestTurn, IsNoTurnAtAllBetweenEqualDirections) {
  const Eigen::Vector3d a(0.3, -2.0, 0.1);
  EXPECT_LT((detail::shortestTurn(a, a) - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(ShortestTurn, IsAHalfTurnBetweenOppositeDirectionsAndNearThem) {
  const Eigen::Vector3d a(0.3, -2.0, 0.1);
  for (const double off : {0.0, 1e-15, 1e-13, 1e-9, 1e-5})
    expectTurn(a, -a + Eigen::Vector3d(off, 0.0, 0.0));
}
