// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/multi_superquadric.h"

#include "mesh_errors.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::enclosedVolume;
using pcl_sq::test::isWatertight;
using pcl_sq::test::Random;

TEST(TriangleMesh, SuperquadricMeshIsClosedFacesOutAndHasItsVolume) {
  Random random(20);
  for (int i = 0; i < 40; ++i) {
    const Superquadric s = random.superquadric();
    const TriangleMesh mesh = meshSuperquadric(s, 32);
    EXPECT_TRUE(isWatertight(mesh));
    EXPECT_NEAR(enclosedVolume(mesh) / s.volume(), 1.0, 0.03)
        << s.epsilon1 << " " << s.epsilon2;
    for (const Eigen::Vector3d& v : mesh.vertices)
      EXPECT_NEAR(s.gauge(v), 1.0, 1e-9);
  }
}

TEST(TriangleMesh, UniformSamplesLieOnTheSurfaceAndAreUniformInArea) {
  Superquadric sphere; // on a sphere the height is uniform (Archimedes)
  const auto points = sampleUniform(sphere, 20000, 5);
  ASSERT_EQ(points.size(), 20000u);
  std::array<int, 10> bins{};
  for (const Eigen::Vector3d& p : points) {
    EXPECT_NEAR(sphere.gauge(p), 1.0, 1e-9);
    ++bins[std::clamp(int((p.z() + 1.0) * 5.0), 0, 9)];
  }
  for (const int bin : bins)
    EXPECT_NEAR(bin, 2000, 200);
  EXPECT_EQ(sampleUniform(sphere, 100, 5), sampleUniform(sphere, 100, 5));
  EXPECT_NE(sampleUniform(sphere, 100, 5), sampleUniform(sphere, 100, 6));
}

TEST(TriangleMesh, EqualDistanceSamplesHaveNeighboursAtTheSpacing) {
  Superquadric s;
  s.semi_axes = {0.1, 0.07, 0.15};
  for (const double e : {0.1, 0.5, 1.0, 1.6}) {
    s.epsilon1 = s.epsilon2 = e;
    const double spacing = 0.01;
    const auto points = sampleEqualDistance(s, spacing);
    ASSERT_GT(points.size(), 100u);
    int isolated = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(s.gauge(points[i]), 1.0, 1e-9);
      double nearest = 1.0;
      for (std::size_t j = 0; j < points.size(); ++j)
        if (i != j)
          nearest = std::min(nearest, (points[i] - points[j]).norm());
      EXPECT_GT(nearest, 1e-6) << "a point is there twice";
      isolated += nearest > 1.5 * spacing;
    }
    EXPECT_EQ(isolated, 0) << "exponent " << e;
  }
  EXPECT_TRUE(sampleEqualDistance(s, 0.0).empty());
}

TEST(MultiSuperquadric, UnionMeshIsClosedLiesOnTheUnionAndHasItsVolume) {
  MultiSuperquadric bottle;
  bottle.parts.resize(2);
  bottle.parts[0].semi_axes = {0.03, 0.03, 0.1};
  bottle.parts[0].epsilon1 = 0.2;
  bottle.parts[1].semi_axes = {0.012, 0.012, 0.04};
  bottle.parts[1].center = {0, 0, 0.13};
  const TriangleMesh mesh = bottle.meshUnion(80);
  EXPECT_TRUE(isWatertight(mesh));
  for (const Eigen::Vector3d& v : mesh.vertices)
    EXPECT_NEAR(bottle.gauge(v), 1.0, 1e-6);
  Random random(21);
  const Eigen::AlignedBox3d box = bottle.boundingBox();
  int inside = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d q(
        random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    inside += bottle.contains(box.min() + box.sizes().cwiseProduct(q));
  }
  EXPECT_NEAR(enclosedVolume(mesh) / (box.volume() * inside / n), 1.0, 0.02);
  EXPECT_TRUE(MultiSuperquadric().meshUnion().vertices.empty());
}

TEST(MultiSuperquadric, MeshOfPartsHoldsEveryPart) {
  MultiSuperquadric two;
  two.parts.resize(2);
  two.parts[1].center.x() = 5.0;
  const TriangleMesh mesh = two.meshParts(8);
  EXPECT_TRUE(isWatertight(mesh));
  EXPECT_EQ(mesh.vertices.size(),
            2 * meshSuperquadric(two.parts[0], 8).vertices.size());
}
