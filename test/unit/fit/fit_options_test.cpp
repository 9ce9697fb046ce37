// SPDX-License-Identifier: BSD-3-Clause
// What a fit is asked for: parameters held, a prior on the size, and what is refused.
#include "pcl_sq/fit_superquadric.h"

#include "fit_body.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(FullFit, CorrectsTheNoisesBiasOnASphere) {
  // noise on a sphere of radius 1 moves the mean radius outwards by sigma^2; without
  // the size prior the fit follows it
  Random random(6);
  constexpr double NOISE = 0.1;
  double with = 0.0, without = 0.0;
  FitOptions o;
  o.robust = false;
  o.fixed = FIX_EPSILON_1 | FIX_EPSILON_2;
  constexpr int TRIALS = 10;
  for (int trial = 0; trial < TRIALS; ++trial) {
    Eigen::Matrix3Xd points(3, 4000);
    for (int i = 0; i < points.cols(); ++i)
      points.col(i) =
          random.direction() +
          NOISE * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    o.size_prior = true;
    with += fitSuperquadric(points, Superquadric(), o).model.semi_axes.mean();
    o.size_prior = false;
    without += fitSuperquadric(points, Superquadric(), o).model.semi_axes.mean();
  }
  EXPECT_NEAR(with / TRIALS, 1.0, 0.002);
  EXPECT_NEAR(without / TRIALS, 1.0 + NOISE * NOISE, 0.002);
}

TEST(FullFit, HoldsParametersAtTheStart) {
  Random random(7);
  const Superquadric truth = object(random);
  Superquadric start = truth;
  start.semi_axes *= 1.2;
  FitOptions o;
  o.fixed = FIX_ROTATION | FIX_EPSILON_1;
  const FitSummary s = fitSuperquadric(surface(random, truth, 400), start, o);
  ASSERT_TRUE(s.ok());
  EXPECT_LT((s.model.rotation - start.rotation).norm(), 1e-9);
  EXPECT_EQ(s.model.epsilon1, start.epsilon1);
  EXPECT_LT((s.model.semi_axes - truth.semi_axes).norm(), 1e-4);
}

TEST(FullFit, HoldsEachParameterAloneAndKnowsItWithoutDoubt) {
  Random random(11);
  const Superquadric truth = object(random);
  Eigen::Matrix3Xd points = surface(random, truth, 400);
  for (int i = 0; i < points.cols(); ++i)
    points.col(i) += 0.0005 * random.normal() * random.direction();
  Superquadric start = truth;
  start.center += 0.002 * random.direction();
  start.rotation *= Eigen::AngleAxisd(0.05, random.direction()).toRotationMatrix();
  start.semi_axes *= 1.1;
  start.epsilon1 += 0.1;
  start.epsilon2 += 0.1;
  for (const unsigned fixed : {FIX_CENTER,
                               FIX_ROTATION,
                               FIX_SEMI_AXIS_1,
                               FIX_SEMI_AXIS_2,
                               FIX_SEMI_AXIS_3,
                               FIX_EPSILON_1,
                               FIX_EPSILON_2}) {
    FitOptions o;
    o.fixed = fixed;
    const FitSummary s = fitSuperquadric(points, start, o);
    ASSERT_TRUE(s.ok());
    const bool held[] = {(s.model.center - start.center).norm() < 1e-9,
                         (s.model.rotation - start.rotation).norm() < 1e-9,
                         std::abs(s.model.semi_axes[0] - start.semi_axes[0]) < 1e-9,
                         std::abs(s.model.semi_axes[1] - start.semi_axes[1]) < 1e-9,
                         std::abs(s.model.semi_axes[2] - start.semi_axes[2]) < 1e-9,
                         s.model.epsilon1 == start.epsilon1,
                         s.model.epsilon2 == start.epsilon2};
    const unsigned groups[] = {FIX_CENTER,
                               FIX_ROTATION,
                               FIX_SEMI_AXIS_1,
                               FIX_SEMI_AXIS_2,
                               FIX_SEMI_AXIS_3,
                               FIX_EPSILON_1,
                               FIX_EPSILON_2};
    for (int i = 0; i < 7; ++i)
      EXPECT_EQ(held[i], groups[i] == fixed) << fixed << ", " << groups[i];
    for (int i = 0; i < 11; ++i)
      EXPECT_EQ(s.covariance(i, i) == 0.0, (fixed >> i & 1U) != 0)
          << fixed << ", " << i;
  }
}

TEST(FullFit, SaysWhyThereIsNoFit) {
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd(3, 0)).termination,
            Termination::TOO_FEW_POINTS);
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd::Random(3, 5)).termination,
            Termination::TOO_FEW_POINTS);
  Eigen::Matrix3Xd line(3, 50);
  for (int i = 0; i < 50; ++i)
    line.col(i) = i * Eigen::Vector3d(1, 2, 3);
  EXPECT_EQ(fitSuperquadric(line).termination, Termination::DEGENERATE);
  FitOptions o;
  o.max_iterations = 0;
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd::Random(3, 50), o).termination,
            Termination::INVALID_OPTIONS);
  o = FitOptions();
  o.fixed = FIX_CENTER; // at what, without a start?
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd::Random(3, 50), o).termination,
            Termination::INVALID_OPTIONS);
  Superquadric far;
  far.center = {0.0, 1e12, 0.0};
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd::Random(3, 50), far).termination,
            Termination::INVALID_OPTIONS);
  far.center *= 1e290; // as numbers go
  EXPECT_EQ(fitSuperquadric(Eigen::Matrix3Xd::Random(3, 50), far).termination,
            Termination::INVALID_OPTIONS);
}

TEST(FullFit, OptionsKnowTheirRanges) {
  FitOptions o;
  EXPECT_TRUE(o.isValid());
  std::string why;
  o.max_outlier_share = 0.95;
  EXPECT_FALSE(o.isValid(&why));
  EXPECT_NE(why.find("max_outlier_share"), std::string::npos);
  o = FitOptions();
  o.noise = -1.0;
  EXPECT_FALSE(o.isValid(&why));
  EXPECT_NE(why.find("noise"), std::string::npos);
}
