// SPDX-License-Identifier: BSD-3-Clause
// The body that a fit finds: from exact, noisy, few, many and foreign points.
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/multi_superquadric.h"

#include "fit_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

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
  for (int trial = 0; trial < 100; ++trial) {
    const Superquadric truth = object(random);
    Eigen::Matrix3Xd points(3, 1600);
    points.leftCols(800) = surface(random, truth, 800);
    for (int i = 800; i < 1600; ++i)
      points.col(i) = truth.center + 0.15 * Eigen::Vector3d(random.uniform(-1, 1),
                                                            random.uniform(-1, 1),
                                                            random.uniform(-1, 1));
    const FitSummary s = fitSuperquadric(points);
    ASSERT_TRUE(s.ok());
    EXPECT_LT(hausdorff(random, s.model, truth), 1e-4) << trial;
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
