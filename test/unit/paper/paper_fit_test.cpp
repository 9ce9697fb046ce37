// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/multi_superquadric.h"

#include "paper/paper_problem.h"
#include "random_superquadric.h"
#include "surface_cloud.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Known shapes that the paper's convention (z = depth) can represent. */
std::vector<Superquadric> knownShapes() {
  std::vector<Superquadric> shapes(4);
  shapes[0].semi_axes.setConstant(0.04);     // sphere
  shapes[1].semi_axes = {0.03, 0.06, 0.045}; // ellipsoid
  shapes[2].semi_axes = {0.05, 0.09, 0.03};  // box
  shapes[2].epsilon1 = shapes[2].epsilon2 = 0.15;
  shapes[3].semi_axes = {0.04, 0.04, 0.1}; // cylinder seen along its axis
  shapes[3].epsilon1 = 0.15;
  for (Superquadric& s : shapes)
    s.center = {0.1, -0.05, 0.9};
  return shapes;
}

} // namespace

TEST(FitSuperquadricPaper, RecoversKnownShapesToOnePercentInTenIterations) {
  for (const Superquadric& truth : knownShapes()) {
    const Eigen::Matrix3Xd points = surfaceCloud(truth, 5000, 3);
    for (const Cost cost : {Cost::PAPER, Cost::SOLINA, Cost::RADIAL}) {
      PaperFitOptions options;
      options.cost = cost;
      Superquadric start = initialSuperquadric(
          points, truth.center, truth.rotation, 2.0 * truth.semi_axes.z(), options);
      start.semi_axes.z() *= 1.2; // the depth is known only roughly
      const FitSummary fit = fitSuperquadricPaper(points, start, options);
      ASSERT_TRUE(fit.ok()) << toString(fit.termination);
      EXPECT_LE(fit.iterations, 10);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(fit.model.semi_axes[k] / truth.semi_axes[k], 1.0, 0.01);
      EXPECT_NEAR(fit.model.epsilon1, truth.epsilon1, 0.01);
      EXPECT_NEAR(fit.model.epsilon2, truth.epsilon2, 0.01);
      EXPECT_LT(fit.rms_distance, 1e-3 * truth.semi_axes.maxCoeff());
    }
  }
}

TEST(FitSuperquadricPaper, TomatoHasItsRadiusAsSemiAxes) { // the paper prints 2 radius
  Superquadric tomato;
  tomato.semi_axes.setConstant(0.035);
  const Eigen::Matrix3Xd points = surfaceCloud(tomato, 4000, 1);
  const FitSummary fit = fitSuperquadricPaper(
      points,
      initialSuperquadric(points, tomato.center, Eigen::Matrix3d::Identity(), 0.07));
  EXPECT_LT((fit.model.semi_axes.array() - 0.035).abs().maxCoeff(), 0.00035);
}

TEST(FitSuperquadricPaper, UprightCylinderNeedsTheBestOfThreeAxisAssignments) {
  Superquadric can; // axis along the image's y: no superquadric with z = depth is one
  can.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  can.semi_axes = {0.04, 0.04, 0.09};
  can.epsilon1 = 0.15;
  const Eigen::Matrix3Xd points = surfaceCloud(can, 5000, 2);
  PaperFitOptions options;
  const Superquadric start = initialSuperquadric(
      points, can.center, Eigen::Matrix3d::Identity(), 0.08, options);
  const FitSummary literal = fitSuperquadricPaper(points, start, options);
  options.axis_assignment = AxisAssignment::BEST_OF_3;
  const FitSummary best = fitSuperquadricPaper(points, start, options);
  EXPECT_LT(best.distortion, 0.05 * literal.distortion);
  EXPECT_NEAR(std::abs(best.model.rotation.col(2).y()), 1.0, 1e-9);
  EXPECT_NEAR(best.model.volume() / can.volume(), 1.0, 0.02);
}

TEST(FitSuperquadricPaper, KeepsPoseAndFirstTwoSemiAxes) {
  Random random(40);
  for (int i = 0; i < 20; ++i) {
    const Superquadric truth = random.superquadric();
    const Eigen::Matrix3Xd points = surfaceCloud(truth, 500, i);
    Superquadric start = truth;
    start.epsilon1 = start.epsilon2 = 1.0;
    const FitSummary fit = fitSuperquadricPaper(points, start);
    EXPECT_EQ(fit.model.center, truth.center);
    EXPECT_EQ(fit.model.rotation, truth.rotation);
    EXPECT_EQ(fit.model.semi_axes.head<2>(), truth.semi_axes.head<2>());
    EXPECT_GE(fit.model.semi_axes.z(), 0.2 * truth.semi_axes.z() - 1e-12);
    EXPECT_LE(fit.model.semi_axes.z(), 1.5 * truth.semi_axes.z() + 1e-12);
    EXPECT_GE(fit.model.epsilon1, 0.1);
    EXPECT_LE(fit.model.epsilon2, 1.9);
  }
}

TEST(FitSuperquadricPaper, NormalEquationsMatchCentralDifferences) {
  Superquadric s; // size about one, as in the fit
  s.semi_axes = {1.0, 0.6, 0.8};
  const detail::UnitPoints points =
      detail::toUnit(surfaceCloud(s, 500, 1, 0.1), detail::Normalisation());
  for (const Cost cost : {Cost::PAPER, Cost::SOLINA, Cost::RADIAL})
    for (int free_axis = 0; free_axis < 3; ++free_axis) {
      PaperFitOptions options;
      options.cost = cost;
      const detail::PaperProblem problem(points, s, free_axis, options);
      const Eigen::Vector3d x(0.8, 1.1, std::log(1.1 * s.semi_axes[free_axis]));
      const auto normal = problem.evaluate(x);
      for (int k = 0; k < 3; ++k) {
        const double h = 1e-3; // the sums are made of floats
        const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
        const double slope =
            (problem.evaluate(x + d).cost - problem.evaluate(x - d).cost) / (2 * h);
        EXPECT_NEAR(2.0 * normal.jtr[k], slope, 2e-3 * std::abs(slope) + 1e-5);
      }
    }
}

TEST(FitSuperquadricPaper, OptimumIsNoWorseThanItsSurroundings) {
  const Superquadric truth = knownShapes()[2];
  const Eigen::Matrix3Xd points = surfaceCloud(truth, 3000, 5, 0.002);
  const Superquadric start =
      initialSuperquadric(points, truth.center, truth.rotation, 0.06);
  const FitSummary fit = fitSuperquadricPaper(points, start);
  for (const double step : {-0.02, 0.02})
    for (int k = 0; k < 3; ++k) {
      Superquadric other = fit.model;
      (k == 0   ? other.epsilon1
       : k == 1 ? other.epsilon2
                : other.semi_axes.z()) *= 1.0 + step;
      if (other.epsilon1 < 0.1 || other.epsilon2 < 0.1)
        continue;
      EXPECT_GE(MultiSuperquadric{{other}}.distortion(points),
                fit.distortion * (1 - 1e-5));
    }
}

TEST(FitSuperquadricPaper, QuantilesIgnoreBorderNoiseInTheWidth) {
  const Superquadric truth = knownShapes()[1];
  Eigen::Matrix3Xd points = surfaceCloud(truth, 5000, 3);
  points.col(7).x() += 0.05;
  PaperFitOptions options;
  const double literal =
      initialSuperquadric(points, truth.center, truth.rotation, 0.1, options)
          .semi_axes.x();
  options.extents = Extents::QUANTILES;
  const double robust =
      initialSuperquadric(points, truth.center, truth.rotation, 0.1, options)
          .semi_axes.x();
  EXPECT_GT(literal, 1.3 * truth.semi_axes.x());
  EXPECT_NEAR(robust / truth.semi_axes.x(), 1.0, 0.03);
}

TEST(FitSuperquadricPaper, NamesWhyThereIsNoModel) {
  const Superquadric start;
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 50);
  EXPECT_EQ(fitSuperquadricPaper(points.leftCols(3), start).termination,
            Termination::TOO_FEW_POINTS);
  EXPECT_EQ(fitSuperquadricPaper(points, start).termination, Termination::DEGENERATE);
  for (int i = 0; i < 50; ++i) // a line, then a plane
    points.col(i) = Eigen::Vector3d(0.1, 0.2, 0.3) * i;
  EXPECT_EQ(fitSuperquadricPaper(points, start).termination, Termination::DEGENERATE);
  points.row(0).setRandom();
  EXPECT_EQ(fitSuperquadricPaper(points, start).termination, Termination::DEGENERATE);
  points.setConstant(std::nan(""));
  EXPECT_EQ(fitSuperquadricPaper(points, start).termination,
            Termination::TOO_FEW_POINTS);
  PaperFitOptions options;
  options.min_epsilon = 3.0;
  std::string why;
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("min_epsilon"), std::string::npos);
  EXPECT_EQ(fitSuperquadricPaper(points, start, options).termination,
            Termination::INVALID_OPTIONS);
  EXPECT_FALSE(FitSummary().ok());
}

TEST(PrincipalAxes, AreARightHandedRotationNearTheCloudsAxes) {
  Random random(42);
  for (int i = 0; i < 50; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = s.epsilon2 = 1.0;
    s.semi_axes = {0.03, 0.06, 0.12};
    s.rotation = Eigen::AngleAxisd(random.uniform(-0.4, 0.4), random.direction())
                     .toRotationMatrix();
    const Eigen::Matrix3d r = principalAxes(surfaceCloud(s, 4000, i));
    EXPECT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
    EXPECT_LT((r - s.rotation).norm(), 0.1);
  }
  EXPECT_EQ(principalAxes(Eigen::Matrix3Xd(3, 0)), Eigen::Matrix3d::Identity());
}
