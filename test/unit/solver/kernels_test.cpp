// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/taper.h"
#include "kernels/kernels.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::kernels;
using pcl_sq::test::Random;

namespace {

constexpr Residual KINDS[] = {Residual::RADIAL,
                              Residual::FIRST_ORDER,
                              Residual::FOOT_POINT,
                              Residual::GAUGE,
                              Residual::SOLINA};

/** \brief A superquadric of size one and points within a tenth of its surface. */
struct Scene {
  Superquadric shape;
  std::vector<Eigen::Vector3d> points;
  detail::UnitPoints packed;

  Scene(Random& random, std::size_t count) {
    shape = random.superquadric();
    shape.center = 0.3 * random.direction();
    shape.semi_axes = {
        random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)};
    shape.epsilon1 = random.uniform(0.1, 1.9);
    shape.epsilon2 = random.uniform(0.1, 1.9);
    packed.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f p =
          (shape.center +
           random.uniform(0.9, 1.1) * (random.surfacePoint(shape) - shape.center))
              .cast<float>();
      points.push_back(p.cast<double>());
      packed.add(p[0], p[1], p[2]);
    }
  }
};

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

/** \brief Planes from their seven arrays, in the order of Planes. */
Planes planesOf(const std::vector<std::vector<float>>& a, std::size_t count) {
  return {a[0].data(),
          a[1].data(),
          a[2].data(),
          a[3].data(),
          a[4].data(),
          a[5].data(),
          a[6].data(),
          count};
}

class EveryIsa : public testing::TestWithParam<Isa> {
protected:
  const Kernels* kernels_ = kernelsFor(GetParam());
  void SetUp() override {
    if (!kernels_)
      GTEST_SKIP() << "this machine lacks the instructions";
  }
};

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
        const Mixture mixture{50.0F, outlier};
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

namespace {

/** \brief A body whose section grows along z, and points beside it. */
Scene taperedScene(Random& random, std::size_t count) {
  Scene scene(random, count);
  scene.shape.kx = random.uniform(-0.8, 0.8);
  scene.shape.ky = random.uniform(-0.8, 0.8);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d grown = scene.shape.deformed(scene.points[i]);
    scene.points[i] = grown.cast<float>().cast<double>();
  }
  scene.packed = {};
  scene.packed.reserve(count);
  for (const Eigen::Vector3d& p : scene.points)
    scene.packed.add(float(p[0]), float(p[1]), float(p[2]));
  return scene;
}

using Squares = Eigen::Matrix<double, TAPERED_ROWS, TAPERED_ROWS>;

template <typename Sums>
void expectProducts(const Sums& sums, const Squares& expected, double tolerance) {
  for (int i = 0; i < TAPERED_ROWS; ++i)
    for (int j = i; j < TAPERED_ROWS; ++j)
      EXPECT_NEAR(sums.products[i][j],
                  expected(i, j),
                  tolerance * (1e-6 + std::sqrt(expected(i, i) * expected(j, j))))
          << i << ", " << j;
}

} // namespace

TEST_P(EveryIsa, DistancesToATaperedBodyAreThoseOfTheSuperquadric) {
  Random random(31);
  for (int trial = 0; trial < 10; ++trial) {
    const Scene scene = taperedScene(random, 301);
    std::vector<float> r(scene.points.size() + 1, -7.0F);
    kernels_->taperedResiduals(
        scene.packed.view(), detail::toShape(scene.shape), r.data());
    for (std::size_t i = 0; i < scene.points.size(); ++i)
      EXPECT_NEAR(r[i], scene.shape.footPointDistance(scene.points[i]), 1e-4);
    EXPECT_EQ(r.back(), -7.0F); // there is no room behind the last point
  }
}

TEST_P(EveryIsa, DistancesOfTaperedBodiesAreThoseInDoublePrecision) {
  Random random(11);
  for (int body = 0; body < 20; ++body) {
    const Scene scene = taperedScene(random, 300);
    SumsOf<TAPERED_ROWS> sums;
    kernels_->taperedEquations(
        scene.packed.view(), detail::toShape(scene.shape), {1.0F, 0.0F}, sums);
    Squares expected = Squares::Zero();
    for (const Eigen::Vector3d& p : scene.points) {
      const detail::BodyRow row = detail::footPointRow(scene.shape, p);
      Eigen::Matrix<double, TAPERED_ROWS, 1> j =
          Eigen::Matrix<double, TAPERED_ROWS, 1>::Zero();
      j.head<TAPERED_PARAMETERS>() = row.derivatives;
      j[TAPERED_PARAMETERS] = row.value;
      expected += j * j.transpose();
    }
    const double square = expected(TAPERED_PARAMETERS, TAPERED_PARAMETERS);
    EXPECT_NEAR(sums.cost, square, 1e-3 * square) << body;
    expectProducts(sums, expected, 2e-3);
  }
}

TEST_P(EveryIsa, PlanesOfTaperedBodiesAreThoseInDoublePrecision) {
  Random random(12);
  for (int body = 0; body < 20; ++body) {
    const Superquadric s = taperedScene(random, 1).shape;
    const std::size_t count = 60, padded = BLOCK;
    std::vector<std::vector<float>> a(7, std::vector<float>(padded, 0.0F));
    Squares expected = Squares::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d n = random.direction().cast<float>().cast<double>();
      const detail::BodyRow row = detail::supportRow(s, n);
      for (int k = 0; k < 3; ++k)
        a[std::size_t(k)][i] = float(n[k]);
      a[3][i] = float(row.value + random.uniform(0.05, 0.1) * (i % 2 ? 1 : -1));
      a[4][i] = float(random.uniform(0.5, 2.0));
      a[5][i] = i % 3 == 0 ? 0.0F : -1e30F;
      const double beyond = row.value - double(a[3][i]);
      if (i % 3 == 0 && beyond < 0.0)
        continue; // a half-space that holds the body
      Eigen::Matrix<double, TAPERED_ROWS, 1> j =
          Eigen::Matrix<double, TAPERED_ROWS, 1>::Zero();
      j.head<TAPERED_PARAMETERS>() = row.derivatives;
      j[TAPERED_PARAMETERS] = beyond;
      expected += std::pow(double(a[4][i]), 2) * j * j.transpose();
    }
    const Planes planes = planesOf(a, count);
    PlaneSumsOf<TAPERED_ROWS> sums;
    kernels_->taperedPlanes(planes, detail::toShape(s), sums);
    SCOPED_TRACE(body);
    // the reach is exact to 1e-7, and so its peak's place to the root of that
    expectProducts(sums, expected, 1e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kernels,
    EveryIsa,
    testing::Values(Isa::PORTABLE, Isa::SSE2, Isa::AVX2, Isa::AVX512));
