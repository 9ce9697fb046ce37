// SPDX-License-Identifier: BSD-3-Clause
// What is asked about models of tapered bodies: boxes, areas, lines, masses.
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

double areaOf(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    sum += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return sum;
}

} // namespace

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
