// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of bent rods and open vessels, against the mathematics point by
// point.
#include "families/vessel_problem.h"
#include "geometry/bend.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;
using pcl_sq::kernels::Isa;
using pcl_sq::test::Random;

namespace {

constexpr Isa ALL[] = {Isa::PORTABLE, Isa::SSE2, Isa::AVX2, Isa::AVX512};

Superquadric rod(Random& random) {
  Superquadric s;
  s.center = 0.3 * random.direction();
  s.rotation = Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction())
                   .toRotationMatrix();
  s.semi_axes = {random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), 1.0};
  s.epsilon1 = random.uniform(0.3, 1.0);
  s.epsilon2 = 1.0;
  s.bend = random.uniform(0.1, 2.0);
  return s;
}

detail::UnitPoints
pointsAbout(const Superquadric& s, Random& random, std::size_t count) {
  detail::UnitPoints points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p =
        s.radialProjection(s.center + random.direction()) + 0.03 * random.direction();
    points.add(float(p.x()), float(p.y()), float(p.z()));
  }
  return points;
}

} // namespace

TEST(BentKernel, SumsAreThoseOfFootPointsOneByOne) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Superquadric s = rod(random);
    const detail::UnitPoints points = pointsAbout(s, random, 150);
    Eigen::Matrix<double, 12, 12> expected = Eigen::Matrix<double, 12, 12>::Zero();
    std::vector<double> distances;
    for (std::size_t i = 0; i < points.size(); ++i) {
      detail::Place foot;
      const detail::BodyRow body =
          detail::footPointRow(s, points[i].cast<double>(), &foot);
      Eigen::Matrix<double, 12, 1> row;
      row.head<10>() = body.derivatives.head<10>();
      row[10] = body.derivatives.head<3>().dot(detail::bendVelocity(s, foot.unbent));
      row[11] = body.value;
      expected += row * row.transpose();
      distances.push_back(body.value);
    }
    for (const Isa isa : ALL) {
      const kernels::Kernels* k = kernels::kernelsFor(isa);
      if (!k)
        continue;
      std::vector<float> own(points.size());
      k->bentResiduals(points.view(), detail::toShape(s), float(s.bend), own.data());
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(own[i], distances[i], 2e-5) << k->name;
      kernels::Sums sums;
      k->bentEquations(points.view(), detail::toShape(s), float(s.bend), {}, sums);
      for (int i = 0; i < 12; ++i)
        for (int j = i; j < 12; ++j)
          EXPECT_NEAR(sums.products[i][j],
                      expected(i, j),
                      2e-3 * std::sqrt(expected(i, i) * expected(j, j)))
              << k->name << " " << i << " " << j;
    }
  }
}

TEST(VesselKernel, GradientIsThatOfTheCost) {
  Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    Superquadric s;
    s.semi_axes = {0.08, 0.08, random.uniform(0.06, 0.12)};
    s.epsilon1 = random.uniform(0.5, 1.0);
    s.kx = s.ky = random.uniform(-0.2, 0.2);
    s.rim = random.uniform(0.1, 0.7);
    s.wall = 0.01;
    Eigen::Matrix3Xd points(3, 400);
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      points.col(i) =
          s.closestPoint(0.08 * random.direction()) + 0.002 * random.direction();
    ViewFitOptions options;
    options.robust = false;
    detail::ViewProblem problem;
    ASSERT_TRUE(problem.prepare(points, {}, options));
    const detail::VesselProblem vessel(
        problem, problem.medium(), 0.05, problem.planes(0.05, problem.medium()));
    const Superquadric body = problem.frame().toUnit(s);
    const auto e = vessel.evaluate(body);
    for (int k = 0; k < detail::VesselProblem::N; ++k) {
      constexpr double STEP = 2e-3;
      const auto costAt = [&](double step) {
        bool limited = false;
        return vessel
            .evaluate(vessel.moved(
                body, step * detail::VesselProblem::Vector::Unit(k), limited))
            .cost;
      };
      const double slope = (costAt(STEP) - costAt(-STEP)) / (2.0 * STEP);
      EXPECT_NEAR(2.0 * e.jtr[k], slope, 0.05 * std::sqrt(e.jtj(k, k) * e.cost))
          << trial << " " << k;
    }
  }
}
