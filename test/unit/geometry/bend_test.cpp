// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/bend.h"

#include "mesh_laws.h"
#include "pcl_sq/line_intersection.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/oriented_box.h"
#include "pcl_sq/triangle_mesh.h"
#include "tapered.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::moved;
using pcl_sq::test::Random;

namespace {

/** \brief Any bent rod of size about one, tapered or not. */
Superquadric anyBent(Random& random, bool tapered = true) {
  Superquadric s = test::anyTapered(random);
  if (!tapered)
    s.kx = s.ky = 0.0;
  else {
    s.kx *= 0.5;
    s.ky *= 0.5;
  }
  s.semi_axes = {
      random.uniform(0.2, 0.4), random.uniform(0.2, 0.4), random.uniform(1.0, 1.5)};
  s.bend = random.uniform(0.3, 1.2) * (random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0);
  s.bend_angle = random.uniform(-3.0, 3.0);
  return s;
}

/** \brief A place of the straight body's surface or near it, deformed. */
Eigen::Vector3d placeNear(Random& random, const Superquadric& s, double gauge) {
  Superquadric straight = s;
  straight.kx = straight.ky = straight.bend = 0.0;
  const Eigen::Vector3d p = random.surfacePoint(straight);
  return s.deformed(s.center + gauge * (p - s.center));
}

/** \brief An arc like the handle of a mug, its hole towards the origin's side. */
Superquadric handle() {
  Superquadric s;
  s.semi_axes = {0.005, 0.008, 0.04};
  s.epsilon1 = 0.2;
  s.bend = 1.0 / 0.03;
  return s;
}

} // namespace

TEST(Bend, StraighteningTakesEveryPlaceBack) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Superquadric s = anyBent(random);
    const Eigen::Vector3d p = placeNear(random, s, random.uniform(0.1, 1.3));
    EXPECT_LT((s.deformed(s.straightened(p)) - p).norm(), 1e-12);
  }
}

TEST(Bend, IsTheCircleOfItsDefinition) {
  Superquadric s;
  s.semi_axes = {0.1, 0.1, 1.0};
  s.bend = 0.8;
  const double radius = 1.0 / s.bend, x = 0.05, z = 0.7;
  const Eigen::Vector3d expected(radius - (radius - x) * std::cos(z / radius),
                                 0.03,
                                 (radius - x) * std::sin(z / radius));
  EXPECT_LT((s.deformed({x, 0.03, z}) - expected).norm(), 1e-15);
  s.bend_angle = M_PI_2; // the same towards y
  EXPECT_LT((s.deformed({-0.03, x, z}) -
             Eigen::Vector3d(-expected.y(), expected.x(), expected.z()))
                .norm(),
            1e-15);
  s.bend = 1e-9; // all but straight
  EXPECT_LT((s.deformed({x, 0.03, z}) - Eigen::Vector3d(x, 0.03, z)).norm(), 1e-9);
}

TEST(Bend, GaugeHasTheDerivativesOfCentralDifferences) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric s = anyBent(random);
    const Eigen::Vector3d p = placeNear(random, s, random.uniform(0.7, 1.2));
    if (s.toLocal(s.straightened(p)).cwiseAbs().minCoeff() < 0.05)
      continue; // a fold of |x|, where no difference is a derivative
    const detail::BodyRow row = detail::logGaugeRow(s, p);
    constexpr double STEP = 1e-6;
    const auto difference = [&](int i) {
      return (std::log(moved(s, i, STEP).gauge(p)) -
              std::log(moved(s, i, -STEP).gauge(p))) /
             (2.0 * STEP);
    };
    for (int i = 0; i < 13; ++i)
      EXPECT_NEAR(
          row.derivatives[i], difference(i), 1e-5 * (1.0 + std::abs(difference(i))))
          << "parameter " << i;
    const detail::Place place = detail::placeOf(s, s.toLocal(p));
    EXPECT_NEAR(
        -detail::logGradient(s, place).dot(detail::bendVelocity(s, place.unbent)),
        difference(13),
        1e-5 * (1.0 + std::abs(difference(13))));
  }
}

TEST(Bend, DistanceIsThatAlongTheNormalCloseToTheSurface) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric s = anyBent(random);
    const Eigen::Vector3d p = placeNear(random, s, 1.0);
    for (const double d : {-0.005, 0.005})
      EXPECT_NEAR(s.footPointDistance(p + d * s.normal(p)), d, 0.001);
  }
}

TEST(Bend, MeshLiesOnTheSurfaceAndHasPappusVolumeCentreAndInertia) {
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const Superquadric s = anyBent(random);
    Superquadric unbent = s;
    unbent.bend = 0.0;
    EXPECT_DOUBLE_EQ(s.volume(),
                     unbent.volume()); // the section's centre is on the axis
    const TriangleMesh mesh = meshSuperquadric(s, 96);
    double volume = 0.0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d a = mesh.vertices[t[0]] - s.center,
                            b = mesh.vertices[t[1]] - s.center,
                            c = mesh.vertices[t[2]] - s.center;
      const double v = a.dot(b.cross(c)) / 6.0;
      const Eigen::Vector3d sum = a + b + c;
      volume += v;
      first += v * sum / 4.0;
      second += v / 20.0 *
                (a * a.transpose() + b * b.transpose() + c * c.transpose() +
                 sum * sum.transpose());
    }
    for (const Eigen::Vector3d& v : mesh.vertices)
      ASSERT_NEAR(s.gauge(v), 1.0, 1e-9);
    EXPECT_NEAR(volume, s.volume(), 0.005 * volume);
    EXPECT_LT((first / volume + s.center - s.centerOfGravity()).norm(), 0.005);
    const Eigen::Matrix3d inertia =
        second.trace() * Eigen::Matrix3d::Identity() - second;
    EXPECT_LT((inertia - s.inertia()).norm(), 0.01 * inertia.norm());
  }
}

TEST(Bend, SupportIsTheFarthestPointOfTheMeshAndHasItsDerivatives) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const Superquadric s = anyBent(random);
    const TriangleMesh mesh = meshSuperquadric(s, 64);
    const Eigen::Vector3d n = random.direction();
    double farthest = -1e300;
    for (const Eigen::Vector3d& v : mesh.vertices)
      farthest = std::max(farthest, n.dot(v - s.center));
    EXPECT_GE(s.support(n), farthest - 1e-9);
    EXPECT_LT(s.support(n), farthest + 0.02);
    EXPECT_NEAR(s.gauge(s.supportPoint(n)), 1.0, 1e-9);
    EXPECT_LE((mesh.vertices[0] - s.center).cwiseAbs().maxCoeff(),
              s.halfSizes().norm() + 1e-12);
    for (const Eigen::Vector3d& v : mesh.vertices)
      ASSERT_LE((s.toLocal(v).cwiseAbs() - s.halfSizes()).maxCoeff(), 1e-9);
    const detail::BodyRow row = detail::supportRow(s, n);
    constexpr double STEP = 1e-5;
    const auto difference = [&](int i) {
      const auto reach = [&](double step) {
        const Superquadric m = moved(s, i, step);
        return n.dot(m.center) + m.support(n);
      };
      return (reach(STEP) - reach(-STEP)) / (2.0 * STEP);
    };
    for (int i = 0; i < 13; ++i)
      EXPECT_NEAR(row.derivatives[i], difference(i), 1e-3) << "parameter " << i;
    const Eigen::Vector3d local = s.rotation.transpose() * n;
    const detail::BentContact contact = detail::BentSupport(s).contact(local);
    EXPECT_NEAR(
        local.dot(detail::bendVelocity(s, contact.unbent)), difference(13), 1e-3);
  }
}

TEST(Bend, ClosestPointIsThatOfBruteForce) {
  Random random(6);
  for (int trial = 0; trial < 15; ++trial) {
    const Superquadric s = anyBent(random);
    const TriangleMesh mesh = meshSuperquadric(s, 128);
    for (int k = 0; k < 5; ++k) {
      const Eigen::Vector3d p =
          s.center + random.uniform(0.2, 2.0) * random.direction();
      double nearest = 1e300;
      for (const Eigen::Vector3d& v : mesh.vertices)
        nearest = std::min(nearest, (v - p).norm());
      const Eigen::Vector3d closest = s.closestPoint(p);
      EXPECT_NEAR(s.gauge(closest), 1.0, 1e-8);
      EXPECT_LE((closest - p).norm(), nearest + 1e-9);
      EXPECT_GT((closest - p).norm(), nearest - 0.05);
      EXPECT_EQ(s.euclideanDistance(p) < 0.0, s.contains(p));
    }
  }
}

TEST(Bend, RaysMeetTheFirstArmAndPassThroughTheHole) {
  const Superquadric s = handle();
  const Eigen::Vector3d end = s.deformed({0.0, 0.0, 0.0399});
  double at;
  // from beyond one arm to the other, along z
  ASSERT_TRUE(firstHit(s, {end.x(), 0.0, -0.1}, Eigen::Vector3d::UnitZ().eval(), at));
  EXPECT_NEAR(s.gauge(Eigen::Vector3d(end.x(), 0.0, at - 0.1)), 1.0, 1e-6);
  EXPECT_LT(at - 0.1, -0.02);
  // between the arms, past the middle
  EXPECT_FALSE(firstHit(s, {0.02, -0.1, 0.0}, Eigen::Vector3d::UnitY().eval(), at));
  Random random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector3d origin = 0.2 * random.direction();
    const Eigen::Vector3d ray = (0.03 * random.direction() - origin).normalized();
    double march = -1.0;
    for (double t = 0.0; t < 0.4 && march < 0.0; t += 2e-5)
      if (s.contains(origin + t * ray))
        march = t;
    if (firstHit(s, origin, ray, at) && march > 0.0) {
      EXPECT_NEAR(at, march, 3e-5);
    } else if (march > 0.0) { // missed: no more than a graze
      EXPECT_GT(s.gauge(origin + (march + 1e-3) * ray), 0.8);
    }
  }
}

TEST(Bend, FingerInTheHoleOfAHandleIsFree) {
  const Superquadric s = handle();
  OrientedBox finger;
  finger.center = {0.022, 0.0, 0.0};
  finger.half_sizes = {0.008, 0.05, 0.008};
  EXPECT_FALSE(collides(finger, s));
  EXPECT_GT(distance(finger, s), 0.002);
  finger.center.x() = 0.008; // into the arc's middle
  EXPECT_TRUE(collides(finger, s));
}

TEST(Bend, MeshOfAUnionWithAHandleIsClosedAndHasItsVolume) {
  MultiSuperquadric model;
  Superquadric body;
  body.semi_axes = {0.04, 0.04, 0.05};
  body.epsilon1 = 0.2;
  body.center = {-0.03, 0.0, 0.0};
  Superquadric arc = handle();
  arc.rotation = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  arc.center = {0.038, 0.0, 0.0};
  model.parts = {body, arc};
  const TriangleMesh mesh = model.meshUnion(48);
  EXPECT_TRUE(test::isWatertight(mesh));
  double volume = 0.0;
  for (const auto& t : mesh.triangles)
    volume +=
        mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  const MassProperties mass = massProperties(model, 128);
  EXPECT_NEAR(volume, mass.volume, 0.01 * mass.volume);
}

TEST(Bend, OutOfRangeIsRefusedWithASentence) {
  std::string why;
  Superquadric s = handle();
  EXPECT_TRUE(s.isValid(&why)) << why;
  s.bend = 90.0;
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("meets itself"), std::string::npos) << why;
  s = handle();
  s.semi_axes = {0.035, 0.035, 0.04};
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("folds"), std::string::npos) << why;
  s = handle();
  s.wall = 0.001;
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("rim or a wall"), std::string::npos) << why;
  s = handle();
  s.bend_angle = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(s.isValid(&why));
}
