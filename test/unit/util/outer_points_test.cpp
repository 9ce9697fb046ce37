// SPDX-License-Identifier: BSD-3-Clause
#include "util/outer_points.h"

#include <gtest/gtest.h>

#include <random>

using pcl_sq::detail::keepOuter;

namespace {

const auto itself = [](const Eigen::Vector2d& p) { return p; };

} // namespace

TEST(OuterPoints, NoneThatALineFindsOutermostIsLeftOut) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(3.0 * normal(random), normal(random));
  std::vector<Eigen::Vector2d> outer = points;
  keepOuter(outer, itself);
  EXPECT_LT(outer.size(), points.size() / 4);
  for (int k = 0; k < 360; ++k) {
    const Eigen::Vector2d n(std::cos(k * M_PI / 180), std::sin(k * M_PI / 180));
    const auto reach = [&n](const std::vector<Eigen::Vector2d>& of) {
      double most = -1e300;
      for (const Eigen::Vector2d& p : of)
        most = std::max(most, n.dot(p));
      return most;
    };
    EXPECT_EQ(reach(outer), reach(points));
  }
}

TEST(OuterPoints, FewPointsAllStay) {
  for (std::size_t count = 0; count < 5; ++count) {
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < count; ++i)
      points.emplace_back(double(i), double(i * i));
    keepOuter(points, itself);
    EXPECT_EQ(points.size(), count);
  }
}
