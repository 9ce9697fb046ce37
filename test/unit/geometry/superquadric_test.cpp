// SPDX-License-Identifier: BSD-3-Clause
// The superquadric as a body: gauge, support, box, volume, coefficients, extremes.
#include "pcl_sq/superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using pcl_sq::Superquadric;
using namespace pcl_sq::test;

TEST(Superquadric, InsideOutsideIsOneOnTheSurface) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d p = s.radialProjection(random.pointNear(s));
    EXPECT_NEAR(s.gauge(p), 1.0, 1e-9);
    EXPECT_NEAR(s.insideOutside(p), 1.0, 1e-6);
    EXPECT_LT(s.insideOutside(s.center + 0.9 * (p - s.center)), 1.0);
    EXPECT_GT(s.insideOutside(s.center + 1.1 * (p - s.center)), 1.0);
  }
}

TEST(Superquadric, InsideOutsideEqualsThePaperEquationAsPrinted) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.3, 2.0);
    s.epsilon2 = random.uniform(0.3, 2.0);
    const Eigen::Vector3d p = random.pointNear(s);
    const Eigen::Array3d q = (s.toLocal(p).array() / s.semi_axes.array()).abs();
    const double f =
        std::pow(std::pow(q.x(), 2 / s.epsilon2) + std::pow(q.y(), 2 / s.epsilon2),
                 s.epsilon2 / s.epsilon1) +
        std::pow(q.z(), 2 / s.epsilon1);
    EXPECT_NEAR(s.insideOutside(p) / f, 1.0, 1e-9);
  }
}

TEST(Superquadric, GaugeIsANorm) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d x = random.pointNear(s) - s.center;
    const Eigen::Vector3d y = random.pointNear(s) - s.center;
    const auto g = [&s](const Eigen::Vector3d& v) { return s.gauge(s.center + v); };
    EXPECT_NEAR(g(3.5 * x), 3.5 * g(x), 1e-9 * g(x));
    EXPECT_NEAR(g(-x), g(x), 1e-9 * g(x));
    EXPECT_LE(g(x + y), (g(x) + g(y)) * (1 + 1e-9));
  }
}

TEST(Superquadric, IsInvariantUnderRigidMotion) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Matrix3d r = random.rotation();
    const Eigen::Vector3d t = random.direction() * 3.0;
    Superquadric m = s;
    m.rotation = r * s.rotation;
    m.center = r * s.center + t;
    const Eigen::Vector3d p = random.pointNear(s), q = r * p + t;
    EXPECT_NEAR(m.gauge(q), s.gauge(p), 1e-7 * s.gauge(p));
    EXPECT_NEAR(m.radialDistance(q), s.radialDistance(p), 1e-7);
    EXPECT_NEAR(m.firstOrderDistance(q), s.firstOrderDistance(p), 1e-6);
    EXPECT_NEAR(m.euclideanDistance(q), s.euclideanDistance(p), 1e-6);
    EXPECT_LT((m.normal(q) - r * s.normal(p)).norm(), 1e-5);
  }
}

TEST(Superquadric, SupportIsTheLargestProjectionAndTouchesTheSurface) {
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d n = random.direction();
    const Eigen::Vector3d c = s.supportPoint(n);
    EXPECT_NEAR(n.dot(c - s.center), s.support(n), 1e-9);
    EXPECT_NEAR(s.gauge(c), 1.0, 1e-6);
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d p = s.radialProjection(random.pointNear(s));
      EXPECT_LE(n.dot(p - s.center), s.support(n) * (1 + 1e-9));
    }
  }
}

TEST(Superquadric, BoundingBoxIsTightAndContainsTheSurface) {
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::AlignedBox3d box = s.boundingBox();
    Eigen::AlignedBox3d sampled;
    for (int k = 0; k < 4000; ++k) {
      const Eigen::Vector3d p =
          s.radialProjection(s.toWorld(random.direction().cwiseProduct(s.semi_axes)));
      sampled.extend(p);
      EXPECT_LT(box.exteriorDistance(p), 1e-9);
    }
    EXPECT_LT((box.sizes() - sampled.sizes()).cwiseQuotient(box.sizes()).maxCoeff(),
              0.2);
  }
}

TEST(Superquadric, VolumeAndInertiaMatchMonteCarlo) {
  Random random(13);
  for (int i = 0; i < 10; ++i) {
    const Superquadric s = random.superquadric();
    const int n = 400000;
    int inside = 0;
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector3d q(
          random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const Eigen::Vector3d local = q.cwiseProduct(s.semi_axes);
      if (s.gauge(s.toWorld(local)) <= 1.0) {
        ++inside;
        second += local * local.transpose();
      }
    }
    const double cell = 8.0 * s.semi_axes.prod() / n;
    EXPECT_NEAR(inside * cell / s.volume(), 1.0, 0.03);
    const Eigen::Matrix3d local_inertia =
        cell * (second.trace() * Eigen::Matrix3d::Identity() - second);
    const Eigen::Matrix3d expected =
        s.rotation * local_inertia * s.rotation.transpose();
    EXPECT_LT((expected - s.inertia()).norm(), 0.04 * s.inertia().norm());
  }
}

TEST(Superquadric, SphereAndBoxVolumesAndInertiaAreTheTextbookOnes) {
  Superquadric sphere;
  sphere.semi_axes.setConstant(0.5);
  EXPECT_NEAR(sphere.volume(), 4.0 / 3.0 * M_PI * 0.125, 1e-12);
  EXPECT_NEAR(sphere.inertia()(0, 0), 0.4 * sphere.volume() * 0.25, 1e-12);
  Superquadric cylinder; // exact in the limit e1 -> 0
  cylinder.epsilon1 = 0.05;
  cylinder.semi_axes = {0.3, 0.3, 0.7};
  EXPECT_NEAR(cylinder.volume(), M_PI * 0.09 * 1.4, 0.002 * cylinder.volume());
}

TEST(Superquadric, CoefficientsGoThereAndBack) {
  Random random(14);
  for (int i = 0; i < 100; ++i) {
    const Superquadric s = random.superquadric();
    const Superquadric t = Superquadric::fromCoefficients(s.toCoefficients());
    EXPECT_LT((s.rotation - t.rotation).norm(), 1e-9);
    EXPECT_LT((s.center - t.center).norm(), 1e-12);
    EXPECT_EQ(s.semi_axes, t.semi_axes);
    EXPECT_EQ(s.epsilon1, t.epsilon1);
    EXPECT_EQ(s.epsilon2, t.epsilon2);
    const Eigen::VectorXf f = s.toCoefficients().cast<float>();
    EXPECT_LT((Superquadric::fromCoefficients(f).rotation - s.rotation).norm(), 1e-5);
  }
}

TEST(Superquadric, StaysFiniteOnTheAxesAtTheCentreFarAwayAndForExtremeShapes) {
  for (const double e1 : {0.05, 0.5, 1.0, 2.0})
    for (const double e2 : {0.05, 0.5, 1.0, 2.0})
      for (const Eigen::Vector3d& a : {Eigen::Vector3d(1, 1, 1),
                                       Eigen::Vector3d(1e-5, 1, 1),
                                       Eigen::Vector3d(1, 1, 1e-5),
                                       Eigen::Vector3d(1e-4, 10, 10)}) {
        Superquadric s;
        s.semi_axes = a;
        s.epsilon1 = e1;
        s.epsilon2 = e2;
        for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0),
                                         Eigen::Vector3d(1, 0, 0),
                                         Eigen::Vector3d(0, -1, 0),
                                         Eigen::Vector3d(0, 0, 1),
                                         Eigen::Vector3d(1, 1, 0),
                                         Eigen::Vector3d(1e6, 1e6, 1e6),
                                         Eigen::Vector3d(0, 0, -1e6),
                                         Eigen::Vector3d(1e-310, 1, 1e-200)}) {
          EXPECT_TRUE(std::isfinite(s.insideOutside(p)));
          EXPECT_TRUE(s.insideOutsideGradient(p).allFinite());
          EXPECT_TRUE(std::isfinite(s.gauge(p)));
          EXPECT_TRUE(s.gaugeGradient(p).allFinite());
          EXPECT_TRUE(s.logGaugeJacobian(p).allFinite());
          EXPECT_TRUE(std::isfinite(s.radialDistance(p)));
          EXPECT_TRUE(std::isfinite(s.firstOrderDistance(p)));
          EXPECT_TRUE(std::isfinite(s.footPointDistance(p)));
          EXPECT_TRUE(std::isfinite(s.euclideanDistance(p)));
          EXPECT_NEAR(s.normal(p).norm(), 1.0, 1e-9);
          EXPECT_TRUE(s.supportPoint(p).allFinite());
          EXPECT_TRUE(s.supportJacobian(p).allFinite());
        }
        EXPECT_GT(s.volume(), 0.0);
        EXPECT_TRUE(s.inertia().allFinite());
      }
}

TEST(Superquadric, IsValidNamesWhatIsWrong) {
  std::string why;
  Superquadric s;
  EXPECT_TRUE(s.isValid(&why));
  s.epsilon1 = 2.5;
  EXPECT_FALSE(s.isValid(&why));
  EXPECT_NE(why.find("exponent"), std::string::npos);
  s = {};
  s.semi_axes.y() = 0.0;
  EXPECT_FALSE(s.isValid(&why));
  s = {};
  s.rotation(0, 0) = -1.0;
  EXPECT_FALSE(s.isValid(&why));
  s = {};
  s.center.x() = std::nan("");
  EXPECT_FALSE(s.isValid(nullptr));
}
