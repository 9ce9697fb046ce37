// SPDX-License-Identifier: BSD-3-Clause
#include "solver/gaussian_uniform.h"
#include "solver/levenberg_marquardt.h"
#include "solver/surface_area.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::detail;
using pcl_sq::test::Random;

namespace {

Superquadric unitShape(Random& random) {
  Superquadric s;
  s.center = 0.2 * random.direction();
  s.rotation = random.rotation();
  s.semi_axes = {
      random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)};
  s.epsilon1 = random.uniform(0.3, 1.6);
  s.epsilon2 = random.uniform(0.3, 1.6);
  return s;
}

UnitPoints
surfacePoints(Random& random, const Superquadric& s, std::size_t count, double noise) {
  UnitPoints points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f p =
        (random.surfacePoint(s) + noise * random.normal() * random.direction())
            .cast<float>();
    points.add(p[0], p[1], p[2]);
  }
  return points;
}

Vector11 randomStep(Random& random, double size) {
  Vector11 step;
  for (int i = 0; i < 11; ++i)
    step[i] = random.uniform(-size, size);
  return step;
}

} // namespace

TEST(LevenbergMarquardt, ReturnsToTheSurfaceThePointsLieOn) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Superquadric truth = unitShape(random);
    const UnitPoints points = surfacePoints(random, truth, 400, 0.0);
    LmOptions o;
    o.max_iterations = 100;
    const LmResult r =
        levenbergMarquardt(points, moved(truth, randomStep(random, 0.1), o), o);
    EXPECT_LT(std::sqrt(r.equations.cost / 400.0), 1e-5);
    EXPECT_TRUE(r.model.isValid());
  }
}

TEST(LevenbergMarquardt, GradientIsTheCostsForEveryMixture) {
  Random random(2);
  const Superquadric shape = unitShape(random);
  const UnitPoints points = surfacePoints(random, shape, 500, 0.05);
  for (const double outlier : {0.0, 0.3}) {
    LmOptions o;
    o.residual = kernels::Residual::RADIAL;
    o.sigma = 0.05;
    o.outlier = outlier;
    const Superquadric at = moved(shape, randomStep(random, 0.05), o);
    const NormalEquations e = sumsOf<11>(points, at, o);
    for (int i = 0; i < 11; ++i) {
      constexpr double STEP = 2e-3;
      const double slope =
          (evaluateCost(points, moved(at, Vector11::Unit(i) * STEP, o), o) -
           evaluateCost(points, moved(at, Vector11::Unit(i) * -STEP, o), o)) /
          (2.0 * STEP);
      EXPECT_NEAR(2.0 * e.jtr[i], slope, 2e-2 * (1.0 + std::abs(slope))) << i;
    }
  }
}

TEST(LevenbergMarquardt, HeldParametersKeepTheirValues) {
  Random random(3);
  const Superquadric truth = unitShape(random);
  const UnitPoints points = surfacePoints(random, truth, 300, 0.01);
  LmOptions o;
  o.space = ParameterSpace::without(1U << 6 | 1U << 9);
  const Superquadric start = moved(truth, randomStep(random, 0.1), o);
  const LmResult r = levenbergMarquardt(points, start, o);
  EXPECT_EQ(r.model.semi_axes[0], start.semi_axes[0]);
  EXPECT_EQ(r.model.epsilon1, start.epsilon1);
  EXPECT_NE(r.model.semi_axes[1], start.semi_axes[1]);
}

TEST(LevenbergMarquardt, ASolidOfRevolutionStaysOne) {
  Random random(4);
  Superquadric truth = unitShape(random);
  truth.semi_axes[1] = truth.semi_axes[0];
  truth.epsilon2 = 1.0;
  const UnitPoints points = surfacePoints(random, truth, 300, 0.02);
  LmOptions o;
  o.space = ParameterSpace::rotational();
  Superquadric start = moved(truth, randomStep(random, 0.1), o);
  start.semi_axes[1] = start.semi_axes[0];
  start.epsilon2 = 1.0;
  const LmResult r = levenbergMarquardt(points, start, o);
  EXPECT_NEAR(r.model.semi_axes[1], r.model.semi_axes[0], 1e-12);
  EXPECT_EQ(r.model.epsilon2, 1.0);
  EXPECT_LT((r.model.semi_axes - truth.semi_axes).norm(), 0.05);
}

TEST(LevenbergMarquardt, StaysInsideTheBounds) {
  Random random(5);
  Superquadric truth = unitShape(random);
  truth.epsilon1 = 0.1;
  const UnitPoints points = surfacePoints(random, truth, 300, 0.0);
  LmOptions o;
  o.min_epsilon = 0.5;
  Superquadric start = truth;
  start.epsilon1 = 1.0;
  start.epsilon2 = std::max(start.epsilon2, 0.5);
  const LmResult r = levenbergMarquardt(points, start, o);
  EXPECT_EQ(r.model.epsilon1, 0.5);
}

TEST(LevenbergMarquardt, AContributorPullsWhereThePointsAreSilent) {
  // the upper end of a can says nothing about where the lower one is; a plane does
  Random random(6);
  Superquadric truth;
  truth.semi_axes = {1.0, 0.8, 0.6};
  truth.epsilon1 = 0.1;
  UnitPoints points;
  points.reserve(200);
  while (points.size() < 200) {
    const Eigen::Vector3d p = random.surfacePoint(truth);
    if (p.z() > 0.35)
      points.add(float(p.x()), float(p.y()), float(p.z()));
  }
  LmOptions o;
  o.max_iterations = 100;
  const Eigen::Vector3d below(0, 0, -1);
  o.contributor = [&below](const Superquadric& s, NormalEquations& e) {
    e.addRow(s.supportJacobian(below), below.dot(s.center) + s.support(below) - 0.8);
  };
  const LmResult r = levenbergMarquardt(points, truth, o);
  EXPECT_NEAR(below.dot(r.model.center) + r.model.support(below), 0.8, 0.03);
  EXPECT_NEAR(-below.dot(r.model.center) + r.model.support(-below), 0.6, 0.03);
}

TEST(LevenbergMarquardt, AHopelessFitEndsAndAPromisingOneGoesOn) {
  Random random(8);
  const Superquadric truth = unitShape(random);
  const UnitPoints points = surfacePoints(random, truth, 300, 0.0);
  Superquadric start = truth;
  start.semi_axes *= 1.3;
  const LmResult free = levenbergMarquardt(points, start, {});
  ASSERT_GT(free.iterations, 3);
  LmOptions o;
  o.hopeless = {2, 0.0};
  EXPECT_EQ(levenbergMarquardt(points, start, o).iterations, 2);
  EXPECT_EQ(levenbergMarquardt(points, start, o).termination, Termination::GIVEN_UP);
  o.hopeless = {2, 1e9};
  EXPECT_EQ(levenbergMarquardt(points, start, o).iterations, free.iterations);
}

TEST(SurfaceArea, OfKnownBodies) {
  const auto area = [](const Eigen::Vector3d& a, double e1, double e2) {
    return std::exp(logArea(a, e1, e2).value);
  };
  EXPECT_NEAR(area({1, 1, 1}, 1, 1), 4 * M_PI, 0.01 * 4 * M_PI);
  EXPECT_NEAR(area({1, 2, 3}, 1, 1), 48.882, 0.01 * 48.882);
  EXPECT_NEAR(area({1, 2, 3}, 0.05, 0.05), 88.0, 0.03 * 88.0);
  EXPECT_NEAR(area({1, 1, 2}, 0.05, 1), 10 * M_PI, 0.03 * 10 * M_PI);
  EXPECT_NEAR(area({1, 1, 1}, 2, 2), 4 * std::sqrt(3.0), 0.01 * 4 * std::sqrt(3.0));
}

TEST(SurfaceArea, DerivativesMatchDifferences) {
  Random random(7);
  constexpr double STEP = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Superquadric s = unitShape(random);
    const LogArea at = logArea(s.semi_axes, s.epsilon1, s.epsilon2);
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d a = s.semi_axes;
      a[k] *= std::exp(STEP);
      EXPECT_NEAR(at.gradient[k],
                  (logArea(a, s.epsilon1, s.epsilon2).value - at.value) / STEP,
                  1e-4);
    }
    EXPECT_NEAR(at.gradient[3],
                (logArea(s.semi_axes, s.epsilon1 + STEP, s.epsilon2).value - at.value) /
                    STEP,
                1e-4);
    EXPECT_NEAR(at.gradient[4],
                (logArea(s.semi_axes, s.epsilon1, s.epsilon2 + STEP).value - at.value) /
                    STEP,
                1e-4);
  }
}
