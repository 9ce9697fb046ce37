// SPDX-License-Identifier: BSD-3-Clause
#include "all_round.h"
#include "pcl_sq/tapered_union.h"
#include "taper_line.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

TaperedSuperquadric anyBody(Random& random) {
  TaperedSuperquadric s;
  s.shape = random.superquadric();
  s.kx = random.uniform(-0.7, 0.7);
  s.ky = random.uniform(-0.7, 0.7);
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

TEST(TaperedUnion, WithoutTapersIsTheSameAsMultiSuperquadric) {
  Random random(91);
  for (int i = 0; i < 10; ++i) {
    MultiSuperquadric model;
    for (int k = 0; k < 3; ++k)
      model.parts.push_back(random.superquadric());
    const TaperedUnion bodies(model);
    EXPECT_FALSE(bodies.isTapered());
    Eigen::Matrix3Xd points(3, 60);
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
      points.col(p) = random.pointNear(model.parts[std::size_t(p % 3)]);
      EXPECT_NEAR(bodies.gauge(points.col(p)), model.gauge(points.col(p)), 1e-9);
      EXPECT_EQ(bodies.distance(points.col(p)), model.euclideanDistance(points.col(p)));
      const Eigen::Vector3d n = random.direction();
      EXPECT_NEAR(bodies.support(n), model.support(n), 1e-6);
    }
    EXPECT_TRUE(bodies.boundingBox().isApprox(model.boundingBox(), 1e-6));
    // the kernels of MultiSuperquadric work in single precision
    EXPECT_NEAR(bodies.distortion(points, 1e-3),
                model.distortion(points, 1e-3),
                2e-3 * model.distortion(points, 1e-3));
    EXPECT_NEAR(bodies.rmsDistance(points),
                model.rmsDistance(points),
                2e-3 * model.rmsDistance(points));
  }
}

TEST(TaperedUnion, BoxHoldsAllPartsAndTheirSurfaceIsAtNoDistance) {
  Random random(92);
  for (int i = 0; i < 10; ++i) {
    TaperedUnion bodies;
    bodies.parts = {anyBody(random), anyBody(random)};
    ASSERT_TRUE(bodies.isTapered());
    const Eigen::AlignedBox3d box = bodies.boundingBox();
    Eigen::AlignedBox3d tight;
    for (const TaperedSuperquadric& body : bodies.parts) {
      const TriangleMesh mesh = meshSuperquadric(body, 60);
      for (const Eigen::Vector3d& v : mesh.vertices) {
        tight.extend(v);
        EXPECT_NEAR(body.gauge(v), 1.0, 1e-6);
        EXPECT_LE(bodies.distance(v), 1e-6);
      }
    }
    EXPECT_TRUE((box.min().array() <= tight.min().array() + 1e-6).all());
    EXPECT_TRUE((box.max().array() >= tight.max().array() - 1e-6).all());
    EXPECT_LT((box.sizes() - tight.sizes()).maxCoeff(), 0.01);
  }
}

TEST(TaperedUnion, EmptyOnesAndPointsThatAreNoneGiveNoFigures) {
  const TaperedUnion none;
  EXPECT_EQ(none.gauge(Eigen::Vector3d::Zero()),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(none.boundingBox().isEmpty());
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Ones(3, 2);
  EXPECT_EQ(none.distortion(points), 0.0);
  EXPECT_EQ(none.rmsDistance(points), 0.0);
  Random random(93);
  TaperedUnion bodies;
  bodies.parts = {anyBody(random)};
  const double one = bodies.rmsDistance(points.leftCols(1));
  points(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bodies.rmsDistance(points), one);
  EXPECT_EQ(bodies.distortion(points), bodies.distortion(points.leftCols(1)));
}

TEST(TaperedSuperquadric, SmallestGaugeOnALineIsThatOfDensePlaces) {
  Random random(94);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const TaperedSuperquadric s = anyBody(random);
    const Eigen::Vector3d towards = random.pointNear(s.shape);
    const Eigen::Vector3d direction = random.direction();
    const Eigen::Vector3d origin = towards - 2.0 * direction;
    double least = 1e300;
    for (int k = 0; k <= 8000; ++k)
      least = std::min(least, s.gauge(origin + 5e-4 * k * direction));
    double at = -1.0;
    const double found = detail::smallestGauge(s, origin, direction, at);
    if (!(found < std::numeric_limits<double>::infinity())) {
      EXPECT_GT(least, 1.0) << "case " << i;
      continue;
    }
    EXPECT_NEAR(s.gauge(origin + at * direction), found, 1e-12);
    if (least < 1.0) {
      EXPECT_LT(found, least + 0.02) << "case " << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 40);
}

TEST(TaperedSuperquadric, OuterAreaOfOneBodyIsItsMeshs) {
  Random random(95);
  for (int i = 0; i < 20; ++i) {
    TaperedSuperquadric s = anyBody(random);
    s.shape.epsilon1 = random.uniform(0.4, 1.4);
    s.shape.epsilon2 = random.uniform(0.4, 1.4);
    const double area = areaOf(meshSuperquadric(s, 60));
    EXPECT_NEAR(detail::outerArea({s}), area, 0.03 * area) << "case " << i;
  }
}

TEST(TaperedSuperquadric, DistancesWithinReachAreKeptWhereTheyAreSmaller) {
  Random random(96);
  int kept = 0;
  for (int i = 0; i < 20; ++i) {
    TaperedSuperquadric s = anyBody(random);
    if (i % 2 == 0)
      s.kx = s.ky = 0.0;
    Eigen::Matrix3Xd points(3, 200);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      points.col(k) = s.shape.center + random.uniform(0.0, 3.0) *
                                           (random.pointNear(s.shape) - s.shape.center);
    const double reach = 0.3 * s.shape.semi_axes.minCoeff();
    const Eigen::VectorXd exact = detail::bodyDistances(s, points);
    Eigen::VectorXd distances = Eigen::VectorXd::Constant(points.cols(), 2.0 * reach);
    detail::keepNearer(
        s, points, Eigen::ArrayXd::Constant(points.cols(), reach), distances);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      if (exact[k] < reach) {
        EXPECT_NEAR(distances[k], exact[k], 1e-5 * reach) << "case " << i;
        ++kept;
      } else
        EXPECT_GE(distances[k], 0.999 * reach) << "case " << i;
  }
  EXPECT_GT(kept, 1000);
}
