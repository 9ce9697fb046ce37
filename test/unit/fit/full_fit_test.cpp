// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/multi_superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

/** \brief Household shapes whose description is not nearly that of another. */
Superquadric object(Random& random) {
  Superquadric s = random.superquadric();
  s.semi_axes = {0.04, 0.06, 0.09};
  s.semi_axes *= random.uniform(0.7, 1.3);
  s.epsilon1 = random.uniform(0.2, 1.2);
  s.epsilon2 = random.uniform(0.2, 1.2);
  return s;
}

Eigen::Matrix3Xd surface(Random& random, const Superquadric& s, int count) {
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) = random.surfacePoint(s);
  return points;
}

/** \brief Largest distance of points of one surface from the other, both ways. */
double hausdorff(Random& random, const Superquadric& a, const Superquadric& b) {
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    largest = std::max(largest, std::abs(a.footPointDistance(random.surfacePoint(b))));
    largest = std::max(largest, std::abs(b.footPointDistance(random.surfacePoint(a))));
  }
  return largest;
}

} // namespace

TEST(FullFit, RecoversTheBodyThatExactPointsLieOn) {
  Random random(1);
  for (int trial = 0; trial < 25; ++trial) {
    const Superquadric truth = object(random);
    const FitSummary s = fitSuperquadric(surface(random, truth, 800));
    ASSERT_TRUE(s.ok()) << toString(s.termination);
    EXPECT_LT(hausdorff(random, s.model, truth), 1e-4);
    EXPECT_LT(s.rms_distance, 1e-6);
    EXPECT_LT(s.outlier_share, 0.01);
  }
}

TEST(FullFit, FindsTheBodyAmongAsManyOutliersAsPoints) {
  Random random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Superquadric truth = object(random);
    Eigen::Matrix3Xd points(3, 1600);
    points.leftCols(800) = surface(random, truth, 800);
    for (int i = 800; i < 1600; ++i)
      points.col(i) = truth.center + 0.15 * Eigen::Vector3d(random.uniform(-1, 1),
                                                            random.uniform(-1, 1),
                                                            random.uniform(-1, 1));
    const FitSummary s = fitSuperquadric(points);
    ASSERT_TRUE(s.ok());
    EXPECT_LT(hausdorff(random, s.model, truth), 1e-4);
    EXPECT_NEAR(s.outlier_share, 0.5, 0.03);
  }
}

TEST(FullFit, EstimatesTheNoise) {
  Random random(3);
  for (const double noise : {0.0005, 0.002}) {
    const Superquadric truth = object(random);
    Eigen::Matrix3Xd points = surface(random, truth, 3000);
    for (int i = 0; i < points.cols(); ++i)
      points.col(i) +=
          noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const FitSummary s = fitSuperquadric(points);
    EXPECT_NEAR(s.sigma, noise, 0.08 * noise);
    EXPECT_LT(hausdorff(random, s.model, truth), 2.0 * noise);
  }
}

TEST(FullFit, DoesNotDependOnTheUnitThePlaceTheOrientationOrTheOrder) {
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const Superquadric truth = object(random);
    Eigen::Matrix3Xd points = surface(random, truth, 700);
    for (int i = 0; i < points.cols(); ++i)
      points.col(i) += 0.001 * random.normal() * random.direction();
    const FitSummary expected = fitSuperquadric(points);
    const Eigen::Matrix3d turn = random.rotation();
    const Eigen::Vector3d shift(30.0, -20.0, 10.0);
    constexpr double UNIT = 1000.0;
    Eigen::Matrix3Xd other = UNIT * (turn * points);
    other.colwise() += shift;
    std::vector<int> order(static_cast<std::size_t>(points.cols()));
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = static_cast<int>(i);
    std::shuffle(order.begin(), order.end(), random.engine());
    Eigen::Matrix3Xd shuffled(3, other.cols());
    for (int i = 0; i < other.cols(); ++i)
      shuffled.col(i) = other.col(order[static_cast<std::size_t>(i)]);
    const FitSummary s = fitSuperquadric(shuffled);
    Superquadric back = s.model;
    back.center = turn.transpose() * (s.model.center - shift) / UNIT;
    back.rotation = turn.transpose() * s.model.rotation;
    back.semi_axes /= UNIT;
    // the noise allows 3e-5; the fit itself moves by its tolerance
    EXPECT_LT(hausdorff(random, back, expected.model), 2e-5);
    EXPECT_NEAR(s.sigma / UNIT, expected.sigma, 1e-3 * expected.sigma);
  }
}

TEST(FullFit, ReadsACloudWhereItIsWithTheSameResult) {
  // few points, and more than are all looked at; as in pcl::PointXYZ, four floats each
  for (const int count : {300, 70000}) {
    Random random(6);
    const Superquadric truth = object(random);
    Eigen::Matrix4Xf cloud = Eigen::Matrix4Xf::Ones(4, count);
    cloud.topRows<3>() = surface(random, truth, count).cast<float>();
    cloud.col(7).setConstant(std::numeric_limits<float>::quiet_NaN());
    const Eigen::Matrix3Xd copy = cloud.topRows<3>().cast<double>();
    const FitSummary expected = fitSuperquadric(copy);
    const FitSummary s = fitSuperquadric(cloud.topRows<3>());
    EXPECT_EQ(s.points, static_cast<std::size_t>(count - 1));
    EXPECT_EQ(s.model.toCoefficients(), expected.model.toCoefficients());
    EXPECT_LT(hausdorff(random, s.model, truth), 1e-4);
    const FitSummary again = fitSuperquadric(cloud.topRows<3>(), s.model);
    EXPECT_LT(hausdorff(random, again.model, truth), 1e-4);
    EXPECT_EQ(surfaceDistances(truth, cloud.topRows<3>()),
              surfaceDistances(truth, copy));
    EXPECT_EQ(principalAxes(cloud.topRows<3>()), principalAxes(copy));
    EXPECT_TRUE(spansVolume(cloud.topRows<3>()));
    const MultiSuperquadric model{{truth}};
    EXPECT_EQ(model.rmsDistance(cloud.topRows<3>()), model.rmsDistance(copy));
    EXPECT_EQ(model.distortion(cloud.topRows<3>()), model.distortion(copy));
  }
}

TEST(FullFit, IsRepeatable) {
  Random random(5);
  const Eigen::Matrix3Xd points = surface(random, object(random), 500);
  const FitSummary first = fitSuperquadric(points), second = fitSuperquadric(points);
  EXPECT_EQ(first.model.toCoefficients(), second.model.toCoefficients());
  EXPECT_EQ(first.iterations, second.iterations);
}

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

TEST(FullFit, CovarianceIsThatOfRepeatedFits) {
  Random random(8);
  const Superquadric truth = object(random);
  constexpr int TRIALS = 60;
  Eigen::VectorXd estimates(TRIALS);
  double predicted = 0.0;
  for (int trial = 0; trial < TRIALS; ++trial) {
    Eigen::Matrix3Xd points = surface(random, truth, 500);
    for (int i = 0; i < points.cols(); ++i)
      points.col(i) +=
          0.001 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const FitSummary s = fitSuperquadric(points, truth);
    estimates[trial] = std::log(s.model.semi_axes[0]);
    predicted += s.covariance(6, 6) / TRIALS;
  }
  const double variance =
      (estimates.array() - estimates.mean()).square().sum() / (TRIALS - 1);
  EXPECT_GT(predicted, 0.5 * variance);
  EXPECT_LT(predicted, 2.0 * variance);
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

TEST(FullFit, LeavesOutPointsThatAreNone) {
  Random random(9);
  const Superquadric truth = object(random);
  Eigen::Matrix3Xd points = surface(random, truth, 500);
  for (int i = 0; i < points.cols(); i += 5)
    points(1, i) = std::nan("");
  const FitSummary s = fitSuperquadric(points);
  EXPECT_EQ(s.points, 400U);
  EXPECT_LT(hausdorff(random, s.model, truth), 1e-4);
}

TEST(FullFit, ManyPointsInFewPlacesAreFitted) {
  // six places of a surface, each many times: the subsets must not come out empty
  Random random(10);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Matrix3Xd places = surface(random, object(random), 6);
    Eigen::Matrix3Xd points(3, 9000);
    for (int i = 0; i < points.cols(); ++i)
      points.col(i) = places.col(i % places.cols());
    const FitSummary s = fitSuperquadric(points);
    EXPECT_TRUE(s.ok() && s.model.isValid()) << toString(s.termination);
  }
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
