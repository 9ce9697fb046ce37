// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_tapered.h"

#include "pcl_sq/triangle_mesh.h"
#include "tapered.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::anyTapered;
using pcl_sq::test::Random;
using pcl_sq::test::straight;

namespace {

/** \brief A paper cup: round, wider at the top; in metres. */
Superquadric cup(Random& random) {
  Superquadric s;
  s.center = {0.1, -0.05, 0.8};
  s.rotation = random.rotation();
  s.semi_axes = {0.036, 0.036, 0.048};
  s.epsilon1 = 0.15;
  s.kx = s.ky = 0.22;
  return s;
}

Eigen::Matrix3Xd
cloudOf(Random& random, const Superquadric& s, int count, double noise) {
  const auto on_shape =
      sampleUniform(straight(s), std::size_t(count), unsigned(random.engine()()));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) =
        s.deformed(on_shape[std::size_t(i)]) +
        noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return points;
}

} // namespace

TEST(TaperedFit, RecoversTheTaperOfACup) {
  Random random(7);
  for (const double noise : {0.0, 0.0003, 0.001})
    for (int trial = 0; trial < 3; ++trial) {
      const Superquadric truth = cup(random);
      const TaperedFit fit = fitTapered(cloudOf(random, truth, 2000, noise));
      ASSERT_TRUE(fit.ok());
      EXPECT_GT(fit.margin, 100.0);
      EXPECT_NEAR(std::abs(fit.model.kx), truth.kx, 0.005 + 10.0 * noise);
      EXPECT_NEAR(std::abs(fit.model.ky), truth.ky, 0.005 + 10.0 * noise);
      EXPECT_GT(fit.model.kx * fit.model.ky, 0.0);
      EXPECT_NEAR(fit.model.volume(), truth.volume(), 0.02 * truth.volume());
      EXPECT_NEAR(fit.sigma, noise, 0.1 * noise + 1e-5);
      EXPECT_LT(fit.rms_distance, 0.5 * fit.untapered.rms_distance);
    }
}

TEST(TaperedFit, RecoversTheTaperAmongOutliers) {
  Random random(8);
  const Superquadric truth = cup(random);
  Eigen::Matrix3Xd points(3, 2600);
  points.leftCols(2000) = cloudOf(random, truth, 2000, 0.0003);
  for (int i = 2000; i < points.cols(); ++i)
    points.col(i) = truth.center + 0.1 * Eigen::Vector3d(random.uniform(-1, 1),
                                                         random.uniform(-1, 1),
                                                         random.uniform(-1, 1));
  const TaperedFit fit = fitTapered(points);
  ASSERT_TRUE(fit.ok());
  EXPECT_NEAR(std::abs(fit.model.kx), truth.kx, 0.02);
  EXPECT_NEAR(fit.outlier_share, 600.0 / 2600.0, 0.04);
}

TEST(TaperedFit, UntaperedPointsNeverTakeATaper) {
  Random random(9);
  for (int trial = 0; trial < 30; ++trial) {
    Superquadric truth = anyTapered(random);
    truth.kx = truth.ky = 0.0;
    const double noise = trial % 3 == 0 ? 0.0 : random.uniform(0.005, 0.05);
    Eigen::Matrix3Xd points = cloudOf(random, truth, 1200, noise);
    if (trial % 2 == 0) { // what lies on one side
      const Eigen::Vector3d side = random.direction();
      int kept = 0;
      for (int i = 0; i < points.cols(); ++i)
        if (side.dot(points.col(i) - truth.center) > 0.0)
          points.col(kept++) = points.col(i);
      points.conservativeResize(3, kept);
    }
    const TaperedFit fit = fitTapered(points);
    ASSERT_TRUE(fit.ok());
    EXPECT_FALSE(fit.model.isTapered()) << "trial " << trial << ": " << fit.margin;
    EXPECT_EQ(fit.model.toCoefficients(), fit.untapered.model.toCoefficients());
    EXPECT_EQ(fit.rms_distance, fit.untapered.rms_distance);
  }
}

TEST(TaperedFit, DeviationsTellHowSureTheTaperIs) {
  // the best taper of a body without any is nothing, give or take its deviation
  Random random(10);
  double sum = 0.0;
  constexpr int TRIALS = 15;
  for (int trial = 0; trial < TRIALS; ++trial) {
    Superquadric truth = cup(random);
    truth.semi_axes.x() = 0.025; // told apart from y
    truth.kx = truth.ky = 0.0;
    const TaperedFit fit =
        fitTapered(cloudOf(random, truth, 1000, 0.0005), {}, Tapering::ALWAYS);
    ASSERT_TRUE(fit.model.isTapered());
    sum += std::pow(fit.model.kx / fit.kx_deviation, 2) / TRIALS;
    EXPECT_LT(std::max(fit.kx_deviation, fit.ky_deviation), 0.02);
  }
  EXPECT_GT(sum, 0.3);
  EXPECT_LT(sum, 3.0);
}

TEST(TaperedFit, DependsNeitherOnTheUnitNorOnThePose) {
  Random random(11);
  const Superquadric truth = cup(random);
  const Eigen::Matrix3Xd points = cloudOf(random, truth, 1500, 0.0005);
  const TaperedFit fit = fitTapered(points);
  const Eigen::Matrix3d turn = random.rotation();
  const Eigen::Vector3d shift(3.0, -2.0, 1.0);
  const TaperedFit other =
      fitTapered((1000.0 * (turn * points)).colwise() + 1000.0 * shift);
  ASSERT_TRUE(fit.ok() && other.ok());
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = truth.deformed(random.surfacePoint(straight(truth)));
    EXPECT_NEAR(other.model.footPointDistance(1000.0 * (turn * p + shift)) / 1000.0,
                fit.model.footPointDistance(p),
                5e-5);
  }
}

TEST(TaperedFit, SaysWhyThereIsNone) {
  EXPECT_FALSE(fitTapered(Eigen::Matrix3Xd(3, 0)).ok());
  FitOptions o;
  o.fixed = FIX_CENTER;
  EXPECT_EQ(fitTapered(Eigen::Matrix3Xd::Random(3, 50), o).untapered.termination,
            Termination::INVALID_OPTIONS);
}
