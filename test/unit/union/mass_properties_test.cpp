// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/mass_properties.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

/** \brief Mass properties of a closed mesh by the divergence theorem. */
MassProperties ofMesh(const TriangleMesh& mesh) {
  MassProperties m;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    const double v = a.dot(b.cross(c)) / 6.0; // tetrahedron with the origin
    const Eigen::Vector3d sum = a + b + c;
    m.volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() +
               sum * sum.transpose());
  }
  m.center = first / m.volume;
  second -= m.volume * m.center * m.center.transpose();
  m.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return m;
}

} // namespace

TEST(MassProperties, OfOnePartAreTheClosedForm) {
  Random random(401);
  for (int i = 0; i < 20; ++i) {
    MultiSuperquadric model;
    model.parts = {random.superquadric()};
    const MassProperties m = massProperties(model);
    EXPECT_NEAR(m.volume, model.parts[0].volume(), 1e-12 * m.volume);
    EXPECT_LT((m.center - model.parts[0].center).norm(), 1e-12);
    EXPECT_LT((m.inertia - model.parts[0].inertia()).norm(),
              1e-6 * model.parts[0].inertia().norm());
  }
}

TEST(MassProperties, ARepeatedPartChangesNothing) {
  Random random(402);
  MultiSuperquadric one, two;
  one.parts = {random.superquadric()};
  two.parts = {one.parts[0], one.parts[0], one.parts[0]};
  const MassProperties a = massProperties(one), b = massProperties(two);
  EXPECT_NEAR(b.volume, a.volume, 0.01 * a.volume);
  EXPECT_LT((b.inertia - a.inertia).norm(), 0.02 * a.inertia.norm());
}

TEST(MassProperties, SeparatePartsAddExactly) {
  MultiSuperquadric model;
  model.parts.resize(2);
  for (Superquadric& s : model.parts)
    s.semi_axes.setConstant(0.1);
  model.parts[1].center = {1.0, 0.0, 0.0};
  const MassProperties m = massProperties(model);
  const double v = 4.0 / 3.0 * M_PI * 1e-3;
  EXPECT_NEAR(m.volume, 2.0 * v, 1e-12);
  EXPECT_LT((m.center - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-12);
  const double own = 0.4 * v * 0.01; // of a ball about its diameter
  EXPECT_NEAR(m.inertia(0, 0), 2.0 * own, 1e-12);
  EXPECT_NEAR(m.inertia(1, 1), 2.0 * (own + v * 0.25), 1e-12); // Steiner
}

TEST(MassProperties, OfOverlappingPartsAreThoseOfTheUnionsSurface) {
  Random random(403);
  for (int i = 0; i < 2; ++i) {
    MultiSuperquadric model;
    model.parts = {random.superquadric(), random.superquadric(), random.superquadric()};
    for (Superquadric& s : model.parts) {
      s.epsilon1 = random.uniform(0.3, 1.2);
      s.epsilon2 = random.uniform(0.3, 1.2);
      s.semi_axes = {random.uniform(0.05, 0.1),
                     random.uniform(0.05, 0.1),
                     random.uniform(0.05, 0.1)};
      s.center = 0.05 * random.direction();
    }
    const MassProperties m = massProperties(model);
    const MassProperties mesh = ofMesh(model.meshUnion(48));
    EXPECT_NEAR(m.volume, mesh.volume, 0.01 * mesh.volume);
    EXPECT_LT((m.center - mesh.center).norm(), 5e-4);
    EXPECT_LT((m.inertia - mesh.inertia).norm(), 0.015 * mesh.inertia.norm());
  }
}

TEST(MassProperties, OfNoPartsAreZero) {
  EXPECT_EQ(massProperties({}).volume, 0.0);
}
