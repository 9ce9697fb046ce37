// SPDX-License-Identifier: BSD-3-Clause
// The kernels of every set of instructions: residuals and sums of plain bodies.
#include "kernel_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::kernels;
using namespace pcl_sq::test;
using Scene = KernelScene;

namespace {

constexpr Residual KINDS[] = {Residual::RADIAL,
                              Residual::FIRST_ORDER,
                              Residual::FOOT_POINT,
                              Residual::GAUGE,
                              Residual::SOLINA};

double exactResidual(const Superquadric& s, Residual kind, const Eigen::Vector3d& p) {
  switch (kind) {
  case Residual::RADIAL:
    return s.radialDistance(p);
  case Residual::FIRST_ORDER:
    return s.firstOrderDistance(p);
  case Residual::FOOT_POINT:
    return s.footPointDistance(p);
  case Residual::GAUGE:
    return s.gauge(p) - 1.0;
  default:
    return s.gauge(p) * s.gauge(p) - 1.0;
  }
}

} // namespace

TEST_P(EveryIsa, ResidualsEqualThoseOfTheSuperquadric) {
  Random random(1);
  for (int trial = 0; trial < 30; ++trial) {
    const Scene scene(random, 77);
    for (const Residual kind : KINDS) {
      std::vector<float> r(scene.points.size());
      kernels_->residuals(
          scene.packed.view(), detail::toShape(scene.shape), kind, r.data());
      for (std::size_t i = 0; i < r.size(); ++i)
        EXPECT_NEAR(r[i], exactResidual(scene.shape, kind, scene.points[i]), 1e-5);
    }
  }
}

TEST_P(EveryIsa, SumsAgreeWithThePortableOnes) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Scene scene(random, 300 + 7 * static_cast<std::size_t>(trial));
    for (const Residual kind : KINDS)
      for (const float outlier : {0.0F, 0.2F}) {
        const kernels::Mixture mixture{50.0F, outlier};
        const Shape shape = detail::toShape(scene.shape);
        Sums expected, sums;
        kernelsFor(Isa::PORTABLE)
            ->normalEquations(scene.packed.view(), shape, kind, mixture, expected);
        kernels_->normalEquations(scene.packed.view(), shape, kind, mixture, sums);
        EXPECT_NEAR(sums.cost, expected.cost, 1e-5 * expected.cost);
        EXPECT_NEAR(sums.share, expected.share, 1e-5 * expected.share);
        for (int i = 0; i < ROWS; ++i)
          for (int j = i; j < ROWS; ++j) {
            const double scale =
                std::sqrt(expected.products[i][i] * expected.products[j][j]);
            EXPECT_NEAR(sums.products[i][j], expected.products[i][j], 1e-5 * scale);
          }
        Sums cost_only;
        kernels_->evaluate(scene.packed.view(), shape, kind, mixture, cost_only);
        EXPECT_NEAR(cost_only.cost, sums.cost, 1e-6 * sums.cost);
      }
  }
}

TEST_P(EveryIsa, NormalEquationsAreTheSumOfTheRows) {
  Random random(3);
  const Scene scene(random, 200);
  Sums sums;
  kernels_->normalEquations(
      scene.packed.view(), detail::toShape(scene.shape), Residual::GAUGE, {}, sums);
  Eigen::Matrix<double, 11, 11> jtj = Eigen::Matrix<double, 11, 11>::Zero();
  Eigen::Matrix<double, 11, 1> jtr = Eigen::Matrix<double, 11, 1>::Zero();
  for (const Eigen::Vector3d& p : scene.points) {
    const double g = scene.shape.gauge(p);
    const Eigen::Matrix<double, 11, 1> row = g * scene.shape.logGaugeJacobian(p);
    jtj += row * row.transpose();
    jtr += row * (g - 1.0);
  }
  for (int i = 0; i < 11; ++i) {
    EXPECT_NEAR(sums.products[i][11], jtr[i], 1e-4 * (1.0 + std::abs(jtr[i])));
    for (int j = i; j < 11; ++j)
      EXPECT_NEAR(
          sums.products[i][j], jtj(i, j), 1e-5 * std::sqrt(jtj(i, i) * jtj(j, j)));
  }
}

TEST_P(EveryIsa, PrecisionMultipliesThePoint) {
  Random random(4);
  Scene scene(random, 50);
  const Shape shape = detail::toShape(scene.shape);
  Sums once, thrice;
  kernels_->normalEquations(scene.packed.view(), shape, Residual::RADIAL, {}, once);
  scene.packed.setPrecision(std::vector<float>(50, 3.0F));
  kernels_->normalEquations(scene.packed.view(), shape, Residual::RADIAL, {}, thrice);
  EXPECT_NEAR(thrice.cost, 3.0 * once.cost, 1e-5 * thrice.cost);
  EXPECT_NEAR(
      thrice.products[6][6], 3.0 * once.products[6][6], 1e-5 * thrice.products[6][6]);
}

TEST_P(EveryIsa, IsFiniteAtTheCentreOnTheAxesAndFarAway) {
  detail::UnitPoints points;
  points.reserve(6);
  points.add(0, 0, 0);
  points.add(1, 0, 0);
  points.add(0, 0, 1);
  points.add(1e-20F, 1e-20F, 0);
  points.add(1e4F, -1e4F, 1e4F);
  points.add(0, 1e4F, 0);
  Superquadric shape;
  for (const double e1 : {0.05, 1.0, 2.0})
    for (const double e2 : {0.05, 1.0, 2.0}) {
      shape.epsilon1 = e1;
      shape.epsilon2 = e2;
      for (const Residual kind : KINDS) {
        Sums sums;
        kernels_->normalEquations(
            points.view(), detail::toShape(shape), kind, {1.0F, 0.1F}, sums);
        EXPECT_TRUE(std::isfinite(sums.cost));
        for (const auto& row : sums.products)
          for (const double x : row)
            EXPECT_TRUE(std::isfinite(x));
      }
    }
}

TEST_P(EveryIsa, PlaneSumsAgreeWithThePortableOnes) {
  Random random(5);
  for (const std::size_t count : {1U, 3U, 52U, 300U}) {
    const std::size_t padded = (count + BLOCK - 1) / BLOCK * BLOCK;
    std::vector<std::vector<float>> a(7, std::vector<float>(padded, 0.0F));
    Superquadric s = random.superquadric();
    s.semi_axes = {0.7, 1.1, 1.6};
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d n = random.direction();
      for (int k = 0; k < 3; ++k)
        a[std::size_t(k)][i] = float(n[k]);
      a[3][i] = float(n.dot(s.center) + s.support(n) + random.normal(0.1));
      a[4][i] = float(random.uniform(0.5, 2.0));
      a[5][i] = i % 3 == 0 ? 0.0F : -1e30F;
      a[6][i] = float(random.uniform(0.0, 2.0));
    }
    const Planes planes = planesOf(a, count);
    PlaneSums expected, sums;
    kernelsFor(Isa::PORTABLE)->planes(planes, detail::toShape(s), expected);
    kernels_->planes(planes, detail::toShape(s), sums);
    for (int i = 0; i < ROWS; ++i) {
      const double size = std::sqrt(expected.products[i][i]);
      EXPECT_NEAR(sums.shared[i],
                  expected.shared[i],
                  1e-4 * (1e-3 + size) * std::sqrt(double(count)));
      for (int j = i; j < ROWS; ++j)
        EXPECT_NEAR(sums.products[i][j],
                    expected.products[i][j],
                    1e-4 * (1e-6 + size * std::sqrt(expected.products[j][j])));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kernels,
    EveryIsa,
    testing::Values(Isa::PORTABLE, Isa::SSE2, Isa::AVX2, Isa::AVX512));
