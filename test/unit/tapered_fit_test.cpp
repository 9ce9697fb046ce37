// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_tapered.h"
#include "taper_row.h"
#include "taper_support.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

TaperedSuperquadric anyTapered(Random& random) {
  TaperedSuperquadric s;
  s.shape = random.superquadric();
  s.shape.semi_axes = {
      random.uniform(0.6, 1.5), random.uniform(0.6, 1.5), random.uniform(0.6, 1.5)};
  s.shape.epsilon1 = random.uniform(0.4, 1.6);
  s.shape.epsilon2 = random.uniform(0.4, 1.6);
  s.kx = random.uniform(-0.6, 0.6);
  s.ky = random.uniform(-0.6, 0.6);
  return s;
}

Eigen::Vector3d surfacePoint(Random& random, const TaperedSuperquadric& s) {
  return s.tapered(random.surfacePoint(s.shape));
}

/** \brief The superquadric with one parameter moved, in the rows' order. */
TaperedSuperquadric moved(TaperedSuperquadric s, int i, double step) {
  Eigen::Vector3d unit = Eigen::Vector3d::Zero();
  unit[i % 3] = 1.0;
  if (i < 3)
    s.shape.center += s.shape.rotation * unit * step;
  else if (i < 6)
    s.shape.rotation *= Eigen::AngleAxisd(step, unit).toRotationMatrix();
  else if (i < 9)
    s.shape.semi_axes[i - 6] *= std::exp(step);
  else
    (i == 9    ? s.shape.epsilon1
     : i == 10 ? s.shape.epsilon2
     : i == 11 ? s.kx
               : s.ky) += step;
  return s;
}

/** \brief A paper cup: round, wider at the top; in metres. */
TaperedSuperquadric cup(Random& random) {
  TaperedSuperquadric s;
  s.shape.center = {0.1, -0.05, 0.8};
  s.shape.rotation = random.rotation();
  s.shape.semi_axes = {0.036, 0.036, 0.048};
  s.shape.epsilon1 = 0.15;
  s.kx = s.ky = 0.22;
  return s;
}

Eigen::Matrix3Xd
cloudOf(Random& random, const TaperedSuperquadric& s, int count, double noise) {
  const auto on_shape =
      sampleUniform(s.shape, std::size_t(count), unsigned(random.engine()()));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) =
        s.tapered(on_shape[std::size_t(i)]) +
        noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return points;
}

} // namespace

TEST(TaperedSuperquadric, GaugeHasTheDerivativesOfCentralDifferences) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const TaperedSuperquadric s = anyTapered(random);
    const Eigen::Vector3d p = s.tapered(random.pointNear(s.shape));
    if (s.shape.toLocal(p).cwiseAbs().minCoeff() < 0.05)
      continue; // a fold of |x|, where no difference is a derivative
    const detail::TaperRow row = detail::taperLogGauge(s, p);
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

TEST(TaperedSuperquadric, DistanceHasTheDerivativesOfCentralDifferencesOnTheSurface) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const TaperedSuperquadric s = anyTapered(random);
    const Eigen::Vector3d p = surfacePoint(random, s);
    if (s.shape.toLocal(p).cwiseAbs().minCoeff() < 0.05)
      continue;
    const detail::TaperRow row = detail::taperRow(s, p);
    EXPECT_NEAR(row.residual, 0.0, 1e-9);
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

TEST(TaperedSuperquadric, DistanceIsThatAlongTheNormalCloseToTheSurface) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const TaperedSuperquadric s = anyTapered(random);
    const Eigen::Vector3d p = surfacePoint(random, s);
    // moving the body by t changes ln G by -gradient . t
    const Eigen::Vector3d normal =
        s.shape.rotation *
        -detail::taperLogGauge(s, p).derivatives.head<3>().normalized();
    for (const double d : {-0.01, 0.01})
      EXPECT_NEAR(s.footPointDistance(p + d * normal), d, 0.001);
  }
}

TEST(TaperedSuperquadric, WithoutTaperIsTheSuperquadric) {
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    TaperedSuperquadric s;
    s.shape = random.superquadric();
    EXPECT_FALSE(s.isTapered());
    const Eigen::Vector3d p = random.pointNear(s.shape);
    EXPECT_NEAR(s.gauge(p), s.shape.gauge(p), 1e-12 * s.shape.gauge(p));
    EXPECT_NEAR(s.footPointDistance(p),
                s.shape.footPointDistance(p),
                1e-9 * s.shape.semi_axes.maxCoeff());
    EXPECT_DOUBLE_EQ(s.volume(), s.shape.volume());
    EXPECT_EQ(s.centerOfGravity(), s.shape.center);
  }
}

TEST(TaperedSuperquadric, MeshLiesOnTheSurfaceAndEnclosesVolumeAndCentre) {
  Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const TaperedSuperquadric s = anyTapered(random);
    const TriangleMesh mesh = meshSuperquadric(s, 96);
    double volume = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    for (const auto& t : mesh.triangles) { // tetrahedra towards the shape's centre
      const Eigen::Vector3d a = mesh.vertices[t[0]] - s.shape.center,
                            b = mesh.vertices[t[1]] - s.shape.center,
                            c = mesh.vertices[t[2]] - s.shape.center;
      const double v = a.dot(b.cross(c)) / 6.0;
      volume += v;
      moment += v * (a + b + c) / 4.0;
    }
    for (const Eigen::Vector3d& v : mesh.vertices)
      ASSERT_NEAR(s.gauge(v), 1.0, 1e-9);
    EXPECT_NEAR(volume, s.volume(), 0.005 * s.volume());
    EXPECT_LT((moment / volume + s.shape.center - s.centerOfGravity()).norm(), 0.005);
  }
}

TEST(TaperedSuperquadric, OppositeTaperIsTheSameBodyTurned) {
  Random random(6);
  const TaperedSuperquadric s = anyTapered(random);
  TaperedSuperquadric turned = s;
  turned.shape.rotation *=
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  turned.kx = -s.kx;
  turned.ky = -s.ky;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = random.pointNear(s.shape);
    EXPECT_NEAR(s.gauge(p), turned.gauge(p), 1e-9 * s.gauge(p));
  }
}

TEST(TaperedSuperquadric, SupportIsTheFarthestVertexOfTheMesh) {
  Random random(81);
  for (int i = 0; i < 60; ++i) {
    TaperedSuperquadric s = anyTapered(random);
    if (i % 3 == 0) // hollow beside one end
      s.kx = s.ky = 0.9;
    const TriangleMesh mesh = meshSuperquadric(s, 80);
    const Eigen::Vector3d n = random.direction();
    double farthest = -1e300;
    for (const Eigen::Vector3d& v : mesh.vertices)
      farthest = std::max(farthest, n.dot(v - s.shape.center));
    EXPECT_GE(s.support(n), farthest - 1e-9);
    EXPECT_NEAR(s.support(n), farthest, 6e-3) << "case " << i;
    EXPECT_NEAR(n.dot(s.supportPoint(n) - s.shape.center), s.support(n), 1e-9);
    EXPECT_NEAR(s.gauge(s.supportPoint(n)), 1.0, 1e-6);
    EXPECT_NEAR(s.support(3.0 * n), 3.0 * s.support(n), 1e-9);
    s.kx = s.ky = 0.0;
    EXPECT_NEAR(s.support(n), s.shape.support(n), 1e-9);
  }
}

TEST(TaperedSuperquadric, SupportHasTheDerivativesOfCentralDifferences) {
  Random random(82);
  constexpr double STEP = 1e-5;
  for (int i = 0; i < 40; ++i) {
    TaperedSuperquadric s = anyTapered(random);
    if (i % 4 == 0)
      s.kx = s.ky = 0.0;
    const Eigen::Vector3d n = random.direction();
    const auto row = detail::taperSupport(s, n);
    EXPECT_NEAR(row.reach, n.dot(s.shape.center) + s.support(n), 1e-9);
    for (int k = 0; k < 13; ++k) {
      const double forward = detail::taperSupport(moved(s, k, STEP), n).reach;
      const double backward = detail::taperSupport(moved(s, k, -STEP), n).reach;
      EXPECT_NEAR(row.derivatives[k], (forward - backward) / (2.0 * STEP), 1e-4)
          << "case " << i << ", parameter " << k;
    }
  }
}

TEST(TaperedSuperquadric, KnowsItsRange) {
  TaperedSuperquadric s;
  s.kx = 0.9;
  EXPECT_TRUE(s.isValid());
  s.ky = -1.0;
  std::string why;
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("taper"), std::string::npos);
  s.ky = std::nan("");
  EXPECT_FALSE(s.isValid());
}

TEST(TaperedFit, RecoversTheTaperOfACup) {
  Random random(7);
  for (const double noise : {0.0, 0.0003, 0.001})
    for (int trial = 0; trial < 3; ++trial) {
      const TaperedSuperquadric truth = cup(random);
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
  const TaperedSuperquadric truth = cup(random);
  Eigen::Matrix3Xd points(3, 2600);
  points.leftCols(2000) = cloudOf(random, truth, 2000, 0.0003);
  for (int i = 2000; i < points.cols(); ++i)
    points.col(i) = truth.shape.center + 0.1 * Eigen::Vector3d(random.uniform(-1, 1),
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
    TaperedSuperquadric truth = anyTapered(random);
    truth.kx = truth.ky = 0.0;
    const double noise = trial % 3 == 0 ? 0.0 : random.uniform(0.005, 0.05);
    Eigen::Matrix3Xd points = cloudOf(random, truth, 1200, noise);
    if (trial % 2 == 0) { // what lies on one side
      const Eigen::Vector3d side = random.direction();
      int kept = 0;
      for (int i = 0; i < points.cols(); ++i)
        if (side.dot(points.col(i) - truth.shape.center) > 0.0)
          points.col(kept++) = points.col(i);
      points.conservativeResize(3, kept);
    }
    const TaperedFit fit = fitTapered(points);
    ASSERT_TRUE(fit.ok());
    EXPECT_FALSE(fit.model.isTapered()) << "trial " << trial << ": " << fit.margin;
    EXPECT_EQ(fit.model.shape.toCoefficients(), fit.untapered.model.toCoefficients());
    EXPECT_EQ(fit.rms_distance, fit.untapered.rms_distance);
  }
}

TEST(TaperedFit, DeviationsTellHowSureTheTaperIs) {
  // the best taper of a body without any is nothing, give or take its deviation
  Random random(10);
  double sum = 0.0;
  constexpr int TRIALS = 15;
  for (int trial = 0; trial < TRIALS; ++trial) {
    TaperedSuperquadric truth = cup(random);
    truth.shape.semi_axes.x() = 0.025; // told apart from y
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
  const TaperedSuperquadric truth = cup(random);
  const Eigen::Matrix3Xd points = cloudOf(random, truth, 1500, 0.0005);
  const TaperedFit fit = fitTapered(points);
  const Eigen::Matrix3d turn = random.rotation();
  const Eigen::Vector3d shift(3.0, -2.0, 1.0);
  const TaperedFit other =
      fitTapered((1000.0 * (turn * points)).colwise() + 1000.0 * shift);
  ASSERT_TRUE(fit.ok() && other.ok());
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = surfacePoint(random, truth);
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
