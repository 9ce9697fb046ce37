// SPDX-License-Identifier: BSD-3-Clause
// The kernels of every set of instructions: distances and planes of tapered bodies.
#include "kernel_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::kernels;
using namespace pcl_sq::test;
using Scene = KernelScene;

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
