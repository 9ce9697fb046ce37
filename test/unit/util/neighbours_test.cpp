// SPDX-License-Identifier: BSD-3-Clause
// The structures that answer "what is near?", against looking at every point.
#include "sensor/local_quadric.h"
#include "util/point_grid.h"
#include "util/voxel_clusters.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

using namespace pcl_sq;
using namespace pcl_sq::detail;
using pcl_sq::test::Random;

namespace {

std::vector<Eigen::Vector3d> scattered(Random& random, std::size_t count) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(
        random.uniform(-1, 1), random.uniform(-0.2, 0.2), random.uniform(0, 3));
  return points;
}

} // namespace

TEST(PointGrid, FindsWhetherAnyPointIsNear) {
  Random random(1);
  const std::vector<Eigen::Vector3d> points = scattered(random, 400);
  const PointGrid grid(points, 0.1);
  int near = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d center(
        random.uniform(-1.5, 1.5), random.uniform(-0.5, 0.5), random.uniform(-1, 4));
    const double radius = random.uniform(0.0, 0.3);
    const bool any = std::any_of(points.begin(), points.end(), [&](const auto& p) {
      return (p - center).norm() <= radius;
    });
    EXPECT_EQ(grid.anyNear(center, radius), any) << i;
    near += any;
  }
  EXPECT_GT(near, 200); // both answers occur
  EXPECT_LT(near, 1800);
}

TEST(PointGrid, FindsWhetherAnyPointIsInABox) {
  Random random(2);
  const std::vector<Eigen::Vector3d> points = scattered(random, 400);
  const PointGrid grid(points, 0.1);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    OrientedBox box;
    box.center = {
        random.uniform(-1.5, 1.5), random.uniform(-0.5, 0.5), random.uniform(-1, 4)};
    box.rotation = random.rotation();
    box.half_sizes = {random.uniform(0.01, 0.3),
                      random.uniform(0.01, 0.3),
                      random.uniform(0.01, 0.3)};
    const double margin = random.uniform(0.0, 0.05);
    const bool any = std::any_of(points.begin(), points.end(), [&](const auto& p) {
      const Eigen::Vector3d local = box.rotation.transpose() * (p - box.center);
      return (local.cwiseAbs() - box.half_sizes).maxCoeff() <= margin;
    });
    EXPECT_EQ(grid.anyIn(box, margin), any) << i;
    found += any;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 900);
}

TEST(Neighbourhood, HoldsTheNearestPoints) {
  Random random(3);
  const std::vector<Eigen::Vector3d> list = scattered(random, 500);
  Eigen::Matrix3Xd points(3, 500);
  for (Eigen::Index i = 0; i < 500; ++i)
    points.col(i) = list[std::size_t(i)];
  Neighbourhood neighbourhood(points, 1);
  for (Eigen::Index i = 0; i < 500; i += 7)
    for (const std::size_t count : {5U, 24U, 96U}) {
      std::vector<Eigen::Index> near = neighbourhood.of(i, count);
      std::vector<Eigen::Index> all(500);
      std::iota(all.begin(), all.end(), 0);
      std::sort(all.begin(), all.end(), [&](Eigen::Index a, Eigen::Index b) {
        return (points.col(a) - points.col(i)).squaredNorm() <
               (points.col(b) - points.col(i)).squaredNorm();
      });
      all.resize(count);
      std::sort(all.begin(), all.end());
      std::sort(near.begin(), near.end());
      EXPECT_EQ(near, all) << i << " of " << count;
    }
}

TEST(VoxelClusters, AreWhatTouchingVoxelsConnect) {
  Random random(4);
  constexpr double GAP = 0.06;
  for (int trial = 0; trial < 10; ++trial) {
    Eigen::Matrix3Xf cloud(3, 150);
    for (Eigen::Index i = 0; i < 150; ++i)
      cloud.col(i) = Eigen::Vector3f(float(random.uniform(0, 1)),
                                     float(random.uniform(0, 1)),
                                     float(random.uniform(0, 0.2)));
    std::vector<int> columns(150);
    std::iota(columns.begin(), columns.end(), 0);
    const auto clusters = clustersOf(cloud, columns, GAP);
    // every point once; two points in touching voxels are together: those nearer than
    // a voxel's side always are, those in one set are linked by steps of 2 sqrt(3)
    std::vector<int> owner(150, -1);
    std::size_t total = 0, last = 1000;
    for (std::size_t k = 0; k < clusters.size(); ++k) {
      EXPECT_LE(clusters[k].size(), last);
      last = clusters[k].size();
      total += clusters[k].size();
      for (const int c : clusters[k])
        owner[std::size_t(c)] = int(k);
    }
    EXPECT_EQ(total, 150u);
    for (int i = 0; i < 150; ++i)
      for (int j = 0; j < i; ++j)
        if ((cloud.col(i) - cloud.col(j)).norm() < float(0.999 * GAP)) {
          EXPECT_EQ(owner[std::size_t(i)], owner[std::size_t(j)]);
        }
    for (const auto& set : clusters) {
      std::set<int> reached = {set.front()};
      std::vector<int> open = {set.front()};
      while (!open.empty()) {
        const int from = open.back();
        open.pop_back();
        for (const int to : set)
          if ((cloud.col(from) - cloud.col(to)).norm() <
                  float(2.0 * std::sqrt(3.0) * GAP) &&
              reached.insert(to).second)
            open.push_back(to);
      }
      EXPECT_EQ(reached.size(), set.size());
    }
  }
}
