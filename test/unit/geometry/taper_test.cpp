// SPDX-License-Identifier: BSD-3-Clause
// Bodies with a taper by themselves: gauge, distances, supports, derivatives.
#include "geometry/taper.h"
#include "pcl_sq/triangle_mesh.h"

#include "tapered.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::anyTapered;
using pcl_sq::test::moved;
using pcl_sq::test::Random;
using pcl_sq::test::straight;

namespace {

Eigen::Vector3d surfacePoint(Random& random, const Superquadric& s) {
  return s.deformed(random.surfacePoint(straight(s)));
}

} // namespace

TEST(Taper, GaugeHasTheDerivativesOfCentralDifferences) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric s = anyTapered(random);
    const Eigen::Vector3d p = s.deformed(random.pointNear(s));
    if (s.toLocal(p).cwiseAbs().minCoeff() < 0.05)
      continue; // a fold of |x|, where no difference is a derivative
    const detail::BodyRow row = detail::logGaugeRow(s, p);
    constexpr double STEP = 1e-6;
    for (int i = 0; i < 13; ++i) {
      const double expected = (std::log(moved(s, i, STEP).gauge(p)) -
                               std::log(moved(s, i, -STEP).gauge(p))) /
                              (2.0 * STEP);
      EXPECT_NEAR(row.derivatives[i], expected, 1e-5 * (1.0 + std::abs(expected)))
          << "parameter " << i;
    }
  }
}

TEST(Taper, DistanceHasTheDerivativesOfCentralDifferencesOnTheSurface) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric s = anyTapered(random);
    const Eigen::Vector3d p = surfacePoint(random, s);
    if (s.toLocal(p).cwiseAbs().minCoeff() < 0.05)
      continue;
    const detail::BodyRow row = detail::footPointRow(s, p);
    EXPECT_NEAR(row.value, 0.0, 1e-9);
    constexpr double STEP = 1e-5;
    for (int i = 0; i < 13; ++i) {
      const double expected = (moved(s, i, STEP).footPointDistance(p) -
                               moved(s, i, -STEP).footPointDistance(p)) /
                              (2.0 * STEP);
      EXPECT_NEAR(row.derivatives[i], expected, 2e-4 * (1.0 + std::abs(expected)))
          << "parameter " << i;
    }
  }
}

TEST(Taper, DistanceIsThatAlongTheNormalCloseToTheSurface) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric s = anyTapered(random);
    const Eigen::Vector3d p = surfacePoint(random, s);
    // moving the body by t changes ln G by -gradient . t
    const Eigen::Vector3d normal =
        s.rotation * -detail::logGaugeRow(s, p).derivatives.head<3>().normalized();
    for (const double d : {-0.01, 0.01})
      EXPECT_NEAR(s.footPointDistance(p + d * normal), d, 0.001);
  }
}

TEST(Taper, MeshLiesOnTheSurfaceAndEnclosesVolumeAndCentre) {
  Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const Superquadric s = anyTapered(random);
    const TriangleMesh mesh = meshSuperquadric(s, 96);
    double volume = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const auto& t : mesh.triangles) { // tetrahedra towards the shape's centre
      const Eigen::Vector3d a = mesh.vertices[t[0]] - s.center,
                            b = mesh.vertices[t[1]] - s.center,
                            c = mesh.vertices[t[2]] - s.center;
      const double v = a.dot(b.cross(c)) / 6.0;
      volume += v;
      moment += v * (a + b + c) / 4.0;
    }
    for (const Eigen::Vector3d& v : mesh.vertices)
      ASSERT_NEAR(s.gauge(v), 1.0, 1e-9);
    EXPECT_NEAR(volume, s.volume(), 0.005 * s.volume());
    EXPECT_LT((moment / volume + s.center - s.centerOfGravity()).norm(), 0.005);
  }
}

TEST(Taper, OppositeTaperIsTheSameBodyTurned) {
  Random random(6);
  const Superquadric s = anyTapered(random);
  Superquadric turned = s;
  turned.rotation *=
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  turned.kx = -s.kx;
  turned.ky = -s.ky;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = random.pointNear(s);
    EXPECT_NEAR(s.gauge(p), turned.gauge(p), 1e-9 * s.gauge(p));
  }
}

TEST(Taper, SupportIsTheFarthestVertexOfTheMesh) {
  Random random(81);
  for (int i = 0; i < 60; ++i) {
    Superquadric s = anyTapered(random);
    if (i % 3 == 0) // hollow beside one end
      s.kx = s.ky = 0.9;
    const TriangleMesh mesh = meshSuperquadric(s, 80);
    const Eigen::Vector3d n = random.direction();
    double farthest = -1e300;
    for (const Eigen::Vector3d& v : mesh.vertices)
      farthest = std::max(farthest, n.dot(v - s.center));
    EXPECT_GE(s.support(n), farthest - 1e-9);
    EXPECT_NEAR(s.support(n), farthest, 6e-3) << "case " << i;
    EXPECT_NEAR(n.dot(s.supportPoint(n) - s.center), s.support(n), 1e-9);
    EXPECT_NEAR(s.gauge(s.supportPoint(n)), 1.0, 1e-6);
    EXPECT_NEAR(s.support(3.0 * n), 3.0 * s.support(n), 1e-9);
    s.kx = s.ky = 0.0;
    EXPECT_NEAR(s.support(n), s.support(n), 1e-9);
  }
}

TEST(Taper, SupportHasTheDerivativesOfCentralDifferences) {
  Random random(82);
  constexpr double STEP = 1e-5;
  for (int i = 0; i < 40; ++i) {
    Superquadric s = anyTapered(random);
    if (i % 4 == 0)
      s.kx = s.ky = 0.0;
    const Eigen::Vector3d n = random.direction();
    const auto row = detail::supportRow(s, n);
    EXPECT_NEAR(row.value, n.dot(s.center) + s.support(n), 1e-9);
    for (int k = 0; k < 13; ++k) {
      const double forward = detail::supportRow(moved(s, k, STEP), n).value;
      const double backward = detail::supportRow(moved(s, k, -STEP), n).value;
      EXPECT_NEAR(row.derivatives[k], (forward - backward) / (2.0 * STEP), 1e-4)
          << "case " << i << ", parameter " << k;
    }
  }
}

TEST(Taper, KnowsItsRange) {
  Superquadric s;
  s.kx = 0.9;
  EXPECT_TRUE(s.isValid());
  s.ky = -1.0;
  std::string why;
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("taper"), std::string::npos);
  s.ky = std::nan("");
  EXPECT_FALSE(s.isValid());
}

TEST(Taper, ClosestPointIsThatOfDensePlaces) {
  Random random(97);
  for (int trial = 0; trial < 12; ++trial) {
    const Superquadric s = anyTapered(random);
    const auto surface = sampleUniform(s, 40000);
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = random.pointNear(s);
      double nearest = 1e300;
      for (const Eigen::Vector3d& q : surface)
        nearest = std::min(nearest, (p - q).norm());
      EXPECT_NEAR(s.gauge(s.closestPoint(p)), 1.0, 1e-6);
      EXPECT_LE(std::abs(s.euclideanDistance(p)), nearest + 1e-9);
      EXPECT_NEAR(std::abs(s.euclideanDistance(p)), nearest, 0.01);
      EXPECT_GE(std::abs(s.footPointDistance(p)),
                std::abs(s.euclideanDistance(p)) - 1e-6);
    }
  }
}

TEST(Taper, EvenMomentsAreThoseOfTheStraightBody) {
  Random random(99);
  for (int trial = 0; trial < 20; ++trial) {
    Superquadric s = straight(anyTapered(random));
    s.rotation.setIdentity();
    EXPECT_NEAR(detail::evenMoment(s, 0, 0, 0), s.volume(), 1e-9 * s.volume());
    const Eigen::Vector3d i = s.inertia().diagonal();
    EXPECT_NEAR(
        detail::evenMoment(s, 0, 0, 2), 0.5 * (i.x() + i.y() - i.z()), 1e-9 * i.norm());
    EXPECT_NEAR(
        detail::evenMoment(s, 2, 0, 0), 0.5 * (i.y() + i.z() - i.x()), 1e-9 * i.norm());
  }
}
