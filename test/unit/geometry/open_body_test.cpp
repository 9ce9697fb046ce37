// SPDX-License-Identifier: BSD-3-Clause
// Bodies with a rim, solid and hollow: laws on random ones.
#include "geometry/open_body.h"
#include "pcl_sq/line_intersection.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/visibility.h"

#include "open_body.h"

#include <gtest/gtest.h>

#include <map>

using namespace pcl_sq;
using pcl_sq::test::anyOpenBody;
using pcl_sq::test::Random;

namespace {

struct MeshMoments {
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
};

MeshMoments momentsOf(const TriangleMesh& mesh, const Eigen::Vector3d& origin) {
  MeshMoments m;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - origin,
                          b = mesh.vertices[t[1]] - origin,
                          c = mesh.vertices[t[2]] - origin;
    const double v = a.dot(b.cross(c)) / 6.0;
    m.volume += v;
    m.first += v * (a + b + c) / 4.0;
  }
  return m;
}

} // namespace

TEST(OpenBody, MeshIsClosedLiesOnTheSurfaceAndEnclosesTheMaterial) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Superquadric s = anyOpenBody(random, trial % 2 == 0);
    const TriangleMesh mesh = meshSuperquadric(s, 64);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        ++edges[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 97)
      ASSERT_NEAR(s.euclideanDistance(mesh.vertices[i]), 0.0, 1e-4) << trial;
    const MeshMoments m = momentsOf(mesh, s.center);
    EXPECT_NEAR(m.volume, s.materialVolume(), 0.02 * s.materialVolume());
    EXPECT_LT((m.first / m.volume + s.center - s.centerOfGravity()).norm(), 0.01);
  }
}

TEST(OpenBody, VolumesAreThoseCountedInABox) {
  Random random(2);
  for (int trial = 0; trial < 6; ++trial) {
    const Superquadric s = anyOpenBody(random, true);
    const Eigen::AlignedBox3d box = s.boundingBox();
    double filled = 0.0, material = 0.0;
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    constexpr int N = 90;
    const Eigen::Vector3d cell = box.sizes() / N;
    for (int i = 0; i < N * N * N; ++i) {
      const Eigen::Vector3d at(i % N + 0.5, i / N % N + 0.5, i / N / N + 0.5);
      const Eigen::Vector3d p = box.min() + cell.cwiseProduct(at);
      filled += s.contains(p);
      if (s.inMaterial(p)) {
        material += 1.0;
        second += (p - s.center) * (p - s.center).transpose();
      }
    }
    EXPECT_NEAR(filled * cell.prod(), s.volume(), 0.01 * s.volume());
    EXPECT_NEAR(material * cell.prod(), s.materialVolume(), 0.03 * s.volume());
    const Eigen::Matrix3d inertia =
        cell.prod() * (second.trace() * Eigen::Matrix3d::Identity() - second);
    EXPECT_LT((inertia - s.inertia()).norm(), 0.05 * inertia.norm());
    MultiSuperquadric model;
    model.parts = {s};
    EXPECT_NEAR(massProperties(model).volume, s.materialVolume(), 1e-12);
  }
}

TEST(OpenBody, SupportIsTheFarthestVertexOfTheMesh) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    Superquadric s = anyOpenBody(random, trial % 2 == 0);
    if (trial % 4 == 0)
      s.kx = s.ky = 0.0;
    const TriangleMesh mesh = meshSuperquadric(s, 80);
    const Eigen::Vector3d n = random.direction();
    double farthest = -1e300;
    for (const Eigen::Vector3d& v : mesh.vertices)
      farthest = std::max(farthest, n.dot(v - s.center));
    EXPECT_GE(s.support(n), farthest - 1e-9);
    EXPECT_NEAR(s.support(n), farthest, 6e-3);
    EXPECT_NEAR(n.dot(s.supportPoint(n) - s.center), s.support(n), 1e-9);
  }
}

TEST(OpenBody, BoxHoldsTheMeshTightly) {
  Random random(6);
  const Superquadric s = anyOpenBody(random, true);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : meshSuperquadric(s, 96).vertices)
    box.extend(v);
  EXPECT_TRUE(s.boundingBox().isApprox(box, 5e-3));
}

TEST(OpenBody, FirstHitIsWhereASampledLineMeetsTheMaterial) {
  Random random(7);
  int inside_seen = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Superquadric s = anyOpenBody(random, true);
    const Eigen::Vector3d target = random.pointNear(s);
    const Eigen::Vector3d eye =
        s.toWorld(Eigen::Vector3d(random.uniform(-4, 4), random.uniform(-4, 4), 6.0));
    const Eigen::Vector3d ray = 2.0 * (target - eye);
    double at = -1.0, expected = -1.0;
    const bool hit = firstHit(s, eye, ray, at);
    for (int i = 0; i < 4000 && expected < 0.0; ++i)
      if (s.inMaterial(eye + i / 4000.0 * ray))
        expected = i / 4000.0;
    if (expected >= 0.0) {
      ASSERT_TRUE(hit) << trial;
      EXPECT_NEAR(at, expected, 2e-3) << trial; // or less, where a wall is thinner
    }
    if (hit) {
      const Eigen::Vector3d p = eye + at * ray;
      EXPECT_NEAR(s.euclideanDistance(p), 0.0, 1e-6);
      LineInterval filled;
      ASSERT_TRUE(intersectLine(s, eye, ray, filled));
      inside_seen += at > filled.enter + 1e-6;
      MultiSuperquadric model;
      model.parts = {s};
      EXPECT_FALSE(isHidden(model, p, eye, 1e-6));
    }
  }
  EXPECT_GT(inside_seen, 20);
}

TEST(OpenBody, WithoutARimNothingChanges) {
  Random random(8);
  const Superquadric s = random.superquadric();
  EXPECT_TRUE(s.isPlain());
  EXPECT_EQ(s.materialVolume(), s.volume());
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p = random.pointNear(s);
    EXPECT_FALSE(s.inHollow(p));
    EXPECT_EQ(s.inMaterial(p), s.contains(p));
  }
}

TEST(OpenBody, RimsAndWallsOutOfRangeAreRefusedWithAReason) {
  Superquadric s;
  s.epsilon1 = 0.5;
  s.rim = 0.5;
  s.wall = 0.1;
  EXPECT_TRUE(s.isValid());
  const auto refused = [&](double rim, double wall) {
    Superquadric bad = s;
    bad.rim = rim;
    bad.wall = wall;
    std::string why;
    EXPECT_FALSE(bad.isValid(&why));
    return why;
  };
  EXPECT_NE(refused(-1.0, 0.0).find("rim"), std::string::npos);
  EXPECT_NE(refused(1.1, 0.0).find("rim"), std::string::npos);
  EXPECT_NE(refused(std::nan(""), 0.0).find("rim"), std::string::npos);
  EXPECT_NE(refused(0.5, -0.1).find("wall"), std::string::npos);
  EXPECT_NE(refused(0.5, 1.1).find("wall"), std::string::npos);
  EXPECT_NE(refused(-0.95, 0.1).find("wall"), std::string::npos);
}

TEST(OpenBody, UnionOfAMugAndItsHandleHasAClosedMeshWithAnInside) {
  Superquadric mug;
  mug.semi_axes = {0.04, 0.04, 0.05};
  mug.epsilon1 = 0.1;
  mug.rim = 0.9;
  mug.wall = 0.004;
  Superquadric handle;
  handle.semi_axes = {0.012, 0.006, 0.03};
  handle.center.x() = 0.05;
  MultiSuperquadric model;
  model.parts = {mug, handle};
  const TriangleMesh mesh = model.meshUnion(48);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges)
    ASSERT_EQ(count, edges.count({edge.second, edge.first}) ? 1 : 0);
  const double volume = momentsOf(mesh, mug.center).volume;
  EXPECT_NEAR(
      volume, mug.materialVolume() + handle.volume(), 0.05 * mug.materialVolume());
}

TEST(OpenBody, ASharpOneThatIsCutLowIsTheSameCutNearItsTop) {
  for (const double rim : {0.0, 0.47, 0.83}) {
    Superquadric mug;
    mug.semi_axes = {0.041, 0.041, 0.057};
    mug.epsilon1 = 0.08;
    mug.kx = mug.ky = 0.07;
    mug.rim = rim;
    mug.wall = 0.004;
    mug.center = {0.1, -0.2, 0.8};
    mug.rotation = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized())
                       .toRotationMatrix();
    const Superquadric same = detail::withRimNearTop(mug);
    EXPECT_TRUE(same.isValid());
    EXPECT_GT(same.rim, 0.85) << rim;
    EXPECT_DOUBLE_EQ(same.wall, mug.wall);
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d up = sign * mug.rotation.col(2);
      EXPECT_NEAR(up.dot(same.center) + same.support(up),
                  up.dot(mug.center) + mug.support(up),
                  1e-9);
    }
    for (const Eigen::Vector3d& p : meshSuperquadric(same, 24).vertices)
      EXPECT_LT((mug.closestPoint(p) - p).norm(), 0.0006) << rim;
  }
}

TEST(OpenBody, ARoundedOneIsLeftAsItIs) {
  Superquadric bowl;
  bowl.semi_axes = {0.08, 0.08, 0.05};
  bowl.rim = 0.1;
  bowl.wall = 0.004;
  EXPECT_EQ(detail::withRimNearTop(bowl).rim, bowl.rim);
  EXPECT_EQ(detail::withRimNearTop(bowl).semi_axes, bowl.semi_axes);
}
