// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/taper.h"
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/line_intersection.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/oriented_box.h"
#include "union/exposed_area.h"

#include "tapered.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::anyTapered;
using pcl_sq::test::Random;
using pcl_sq::test::straight;

namespace {

Eigen::Vector3d surfacePoint(Random& random, const Superquadric& s) {
  return s.deformed(random.surfacePoint(straight(s)));
}

/** \brief The superquadric with one parameter moved, in the rows' order. */
Superquadric moved(Superquadric s, int i, double step) {
  Eigen::Vector3d unit = Eigen::Vector3d::Zero();
  unit[i % 3] = 1.0;
  if (i < 3)
    s.center += s.rotation * unit * step;
  else if (i < 6)
    s.rotation *= Eigen::AngleAxisd(step, unit).toRotationMatrix();
  else if (i < 9)
    s.semi_axes[i - 6] *= std::exp(step);
  else
    (i == 9 ? s.epsilon1 : i == 10 ? s.epsilon2 : i == 11 ? s.kx : s.ky) += step;
  return s;
}

double areaOf(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return sum;
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

TEST(Taper, BoxHoldsAllPartsAndTheirSurfaceIsAtNoDistance) {
  Random random(92);
  for (int i = 0; i < 10; ++i) {
    MultiSuperquadric bodies;
    bodies.parts = {anyTapered(random), anyTapered(random)};
    const Eigen::AlignedBox3d box = bodies.boundingBox();
    Eigen::AlignedBox3d tight;
    int vertices = 0;
    for (const Superquadric& body : bodies.parts) {
      const TriangleMesh mesh = meshSuperquadric(body, 60);
      for (const Eigen::Vector3d& v : mesh.vertices) {
        tight.extend(v);
        EXPECT_NEAR(body.gauge(v), 1.0, 1e-6);
        if (++vertices % 500 == 0) {
          EXPECT_LE(bodies.euclideanDistance(v), 1e-6);
        }
      }
    }
    EXPECT_TRUE((box.min().array() <= tight.min().array() + 1e-6).all());
    EXPECT_TRUE((box.max().array() >= tight.max().array() - 1e-6).all());
    EXPECT_LT((box.sizes() - tight.sizes()).maxCoeff(), 0.01);
  }
}

TEST(Taper, ExposedAreaOfOneBodyIsItsMeshs) {
  Random random(95);
  for (int i = 0; i < 20; ++i) {
    Superquadric s = anyTapered(random);
    s.epsilon1 = random.uniform(0.4, 1.4);
    s.epsilon2 = random.uniform(0.4, 1.4);
    const double area = areaOf(meshSuperquadric(s, 60));
    EXPECT_NEAR(detail::exposedArea({s}), area, 0.03 * area) << "case " << i;
  }
}

TEST(Taper, DistancesWithinReachAreKeptWhereTheyAreSmaller) {
  Random random(96);
  int kept = 0;
  for (int i = 0; i < 20; ++i) {
    Superquadric s = anyTapered(random);
    if (i % 2 == 0)
      s.kx = s.ky = 0.0;
    Eigen::Matrix3Xd points(3, 400);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      points.col(k) =
          s.center + random.uniform(0.0, 3.0) * (random.pointNear(s) - s.center);
    const double reach = 0.3 * s.semi_axes.minCoeff();
    const Eigen::VectorXd exact = surfaceDistances(s, points);
    Eigen::VectorXd distances = Eigen::VectorXd::Constant(points.cols(), 2.0 * reach);
    detail::keepNearer(
        s, points, Eigen::ArrayXd::Constant(points.cols(), reach), distances);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      if (exact[k] < reach) {
        // what is deeper than the reach is hidden, however deep it is
        EXPECT_NEAR(
            std::max(distances[k], -reach), std::max(exact[k], -reach), 1e-5 * reach)
            << "case " << i;
        ++kept;
      } else
        EXPECT_GE(distances[k], 0.999 * reach) << "case " << i;
  }
  EXPECT_GT(kept, 1000);
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

TEST(Taper, LinesEnterAndLeaveOnTheSurface) {
  Random random(94);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Superquadric s = anyTapered(random);
    const Eigen::Vector3d direction = random.direction();
    const Eigen::Vector3d origin = random.pointNear(s) - 4.0 * direction;
    double least = 1e300;
    for (int k = 0; k <= 8000; ++k)
      least = std::min(least, s.gauge(origin + 1e-3 * k * direction));
    LineInterval found;
    if (!intersectLine(s, origin, direction, found)) {
      EXPECT_GT(least, 0.98) << "case " << i;
      continue;
    }
    ++hits;
    EXPECT_NEAR(s.gauge(origin + found.enter * direction), 1.0, 1e-9);
    EXPECT_NEAR(s.gauge(origin + found.leave * direction), 1.0, 1e-9);
    EXPECT_LE(s.gauge(origin + 0.5 * (found.enter + found.leave) * direction), 1.0);
    LineInterval box;
    ASSERT_TRUE(intersectLineBox(s, origin, direction, box));
    EXPECT_LE(box.enter, found.enter + 1e-9);
    EXPECT_GE(box.leave, found.leave - 1e-9);
  }
  EXPECT_GT(hits, 40);
}

TEST(Taper, MassPropertiesAreThoseOfRandomPlacesInside) {
  Random random(98);
  for (int trial = 0; trial < 6; ++trial) {
    MultiSuperquadric model;
    model.parts = {anyTapered(random)};
    const Superquadric& s = model.parts[0];
    const Eigen::AlignedBox3d box = s.boundingBox();
    constexpr int SAMPLES = 400000;
    double inside = 0.0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int i = 0; i < SAMPLES; ++i) {
      const Eigen::Vector3d unit(
          random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
      const Eigen::Vector3d p = box.min() + unit.cwiseProduct(box.sizes());
      if (s.gauge(p) > 1.0)
        continue;
      inside += 1.0;
      first += p;
      second += p * p.transpose();
    }
    const Eigen::Vector3d center = first / inside;
    const double volume = box.volume() * inside / SAMPLES;
    second = volume * (second / inside - center * center.transpose());
    const Eigen::Matrix3d inertia =
        second.trace() * Eigen::Matrix3d::Identity() - second;
    const MassProperties found = massProperties(model);
    EXPECT_NEAR(found.volume, volume, 0.01 * volume);
    EXPECT_LT((found.center - center).norm(), 0.01);
    EXPECT_LT((found.inertia - inertia).norm(), 0.02 * inertia.norm());
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

TEST(Taper, UnionsFiguresAreThoseOfTheirPoints) {
  Random random(93);
  MultiSuperquadric model;
  model.parts = {anyTapered(random), straight(anyTapered(random))};
  Eigen::Matrix3Xd points(3, 200);
  double squares = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) = random.pointNear(model.parts[std::size_t(i % 2)]);
    squares +=
        std::pow(std::min(std::abs(model.parts[0].footPointDistance(points.col(i))),
                          std::abs(model.parts[1].footPointDistance(points.col(i)))),
                 2);
  }
  EXPECT_NEAR(model.rmsDistance(points),
              std::sqrt(squares / double(points.cols())),
              1e-3 * model.rmsDistance(points));
  const Eigen::VectorXd distances = surfaceDistances(model.parts[0], points);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    EXPECT_NEAR(distances[i], model.parts[0].footPointDistance(points.col(i)), 1e-4);
}

TEST(Taper, BoxesCollideWithWhatTheyTouch) {
  Random random(100);
  int apart = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Superquadric s = anyTapered(random);
    OrientedBox box;
    box.center = random.pointNear(s);
    box.rotation = random.rotation();
    box.half_sizes = {0.1, 0.2, 0.15};
    bool touched = false;
    for (int i = 0; i < 3000 && !touched; ++i) {
      const Eigen::Vector3d q(
          random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      touched =
          s.gauge(box.center + box.rotation * q.cwiseProduct(box.half_sizes)) <= 1.0;
    }
    EXPECT_TRUE(!touched || collides(box, s)) << "case " << trial;
    apart += collides(box, s) ? 0 : 1;
  }
  EXPECT_GT(apart, 30);
}
