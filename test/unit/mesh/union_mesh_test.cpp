// SPDX-License-Identifier: BSD-3-Clause
// Laws of the meshes of unions with few triangles, on bodies as people own them and on
// the worst that a model file may hold.
#include "mesh/union_mesh.h"

#include "mesh_errors.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

Superquadric body(const Eigen::Vector3d& semi_axes,
                  double e1,
                  double e2,
                  const Eigen::Vector3d& center = Eigen::Vector3d::Zero()) {
  Superquadric s;
  s.semi_axes = semi_axes;
  s.epsilon1 = e1;
  s.epsilon2 = e2;
  s.center = center;
  return s;
}

Superquadric askew(Superquadric s) {
  s.rotation =
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return s;
}

MultiSuperquadric unionOf(const std::vector<Superquadric>& parts) {
  MultiSuperquadric model;
  model.parts = parts;
  return model;
}

MultiSuperquadric randomParts(int count, unsigned seed) {
  Random random(seed);
  MultiSuperquadric model;
  for (int i = 0; i < count; ++i) {
    Superquadric s = random.superquadric();
    s.semi_axes *= 0.2;
    s.center = 0.03 * Eigen::Vector3d(random.uniform(-1, 1),
                                      random.uniform(-1, 1),
                                      random.uniform(-1, 1));
    if (i % 3 == 2) {
      s.kx = random.uniform(-0.8, 0.8);
      s.ky = random.uniform(-0.8, 0.8);
    }
    model.parts.push_back(s);
  }
  return model;
}

/** \brief Share of the bounding box that is in the union, times its volume. */
double sampledVolume(const MultiSuperquadric& model) {
  constexpr int COUNT = 100000;
  Random random(21);
  const Eigen::AlignedBox3d box = model.boundingBox();
  int inside = 0;
  for (int i = 0; i < COUNT; ++i) {
    const Eigen::Vector3d q(
        random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    inside += model.contains(box.min() + box.sizes().cwiseProduct(q));
  }
  return box.volume() * inside / COUNT;
}

void expectLaws(const MultiSuperquadric& model, double tolerance, const char* what) {
  SCOPED_TRACE(what);
  const TriangleMesh mesh = detail::remeshUnion(model, tolerance);
  ASSERT_TRUE(test::isWatertight(mesh));
  const test::MeshErrors errors = test::errorsOf(model, mesh, tolerance, 400);
  EXPECT_LT(errors.outward, tolerance);
  EXPECT_LT(errors.inward, tolerance);
  EXPECT_LT(errors.askew, 0.02);
  const double volume = sampledVolume(model);
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    area += 0.5 * test::doubleArea(mesh, t).norm();
  // the samples' own error is about half a percent
  EXPECT_NEAR(test::enclosedVolume(mesh), volume, area * tolerance + 0.02 * volume);
}

} // namespace

TEST(UnionMesh, ABodyOfFlatFacesHasNoMoreTrianglesThanTheyNeed) {
  const TriangleMesh mesh =
      detail::remeshUnion(unionOf({body({0.04, 0.03, 0.05}, 2, 2)}), 1e-4);
  EXPECT_TRUE(test::isWatertight(mesh));
  EXPECT_EQ(mesh.triangles.size(), 8u);
}

TEST(UnionMesh, SingleBodiesKeepTheLaws) {
  expectLaws(unionOf({body({0.02, 0.03, 0.05}, 0.1, 0.1)}), 3e-4, "box");
  expectLaws(unionOf({askew(body({0.02, 0.03, 0.05}, 2, 0.05))}), 3e-4, "prism");
  expectLaws(unionOf({body({0.05, 0.05, 0.001}, 0.1, 1)}), 3e-4, "thin plate");
  expectLaws(unionOf({body({0.0005, 0.0005, 0.05}, 0.1, 1)}), 1e-4, "needle");
  Superquadric cup = body({0.03, 0.03, 0.05}, 0.1, 1);
  cup.kx = cup.ky = 0.8;
  expectLaws(unionOf({cup}), 3e-4, "tapered");
}

TEST(UnionMesh, SeamsKeepTheLaws) {
  const Superquadric upright = body({0.01, 0.01, 0.05}, 0.1, 0.1);
  const Superquadric can = body({0.03, 0.03, 0.03}, 0.5, 1);
  expectLaws(unionOf({body({0.04, 0.04, 0.05}, 0.1, 1),
                      body({0.005, 0.005, 0.03}, 0.3, 1, {0.043, 0, 0})}),
             2e-4,
             "mug");
  expectLaws(
      unionOf({upright, body({0.01, 0.05, 0.01}, 0.1, 0.1)}), 2e-4, "crossed bars");
  expectLaws(unionOf({upright, askew(body({0.01, 0.05, 0.012}, 0.1, 0.1))}),
             2e-4,
             "bars crossed askew");
  expectLaws(unionOf({can, askew(body({0.03, 0.04, 0.05}, 2, 2))}), 3e-4, "octahedron");
  expectLaws(unionOf({can, askew(body({0.0007, 0.0007, 0.06}, 0.1, 1))}),
             3e-4,
             "needle through a can");
}

TEST(UnionMesh, BodiesThatTouchOrNearlyCoincideKeepTheLaws) {
  const Superquadric ball = body({0.03, 0.03, 0.03}, 1, 1);
  const Superquadric can = body({0.03, 0.03, 0.05}, 0.1, 1);
  expectLaws(unionOf({can, can}), 3e-4, "twice the same");
  expectLaws(unionOf({can, body({0.03002, 0.03, 0.05}, 0.1, 1, {0, 0, 1e-5})}),
             3e-4,
             "nearly the same");
  expectLaws(
      unionOf({ball, body({0.03, 0.03, 0.03}, 1, 1, {0.06, 0, 0})}), 3e-4, "touching");
  expectLaws(
      unionOf({ball, body({0.01, 0.01, 0.01}, 1, 1, {0.01, 0, 0})}), 3e-4, "inside");
  expectLaws(
      unionOf({ball, body({0.01, 0.01, 0.01}, 1, 1, {0.1, 0, 0})}), 3e-4, "apart");
}

TEST(UnionMesh, RandomBodiesKeepTheLaws) {
  for (const unsigned seed : {1u, 2u})
    expectLaws(randomParts(4, seed), 3e-4, "4 parts");
  expectLaws(randomParts(16, 3), 5e-4, "16 parts");
}
