// SPDX-License-Identifier: BSD-3-Clause
// Costs of planes that touch a body or bound it, and their derivatives.
#include "pcl_sq/silhouette.h"

#include "random_superquadric.h"
#include "solver/levenberg_marquardt.h"
#include "view_problem/plane_cost.h"
#include "view_problem/plane_sums.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

/** \brief A cost as it is defined, plane by plane. */
void addExactly(const detail::PlaneCost& cost,
                const Superquadric& s,
                detail::NormalEquations& e) {
  const auto row = [&](const Eigen::Vector3d& normal) {
    detail::PlaneRow<11> r;
    r.derivatives = s.supportJacobian(normal, r.reach);
    r.reach += normal.dot(s.center);
    return r;
  };
  const auto reach = [&](const Eigen::Vector3d& normal) {
    return normal.dot(s.center) + s.support(normal);
  };
  detail::addPlaneCost<11>(cost, row, reach, e);
}

} // namespace

TEST(TangentPlane, JacobianAgreesWithCentralDifferences) {
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.2, 1.8);
    s.epsilon2 = random.uniform(0.2, 1.8);
    TangentPlane plane;
    plane.normal = random.direction();
    const SuperquadricCoefficients jacobian = plane.jacobian(s);
    for (int k = 0; k < 11; ++k) {
      detail::Vector11 step = detail::Vector11::Zero();
      step[k] = 1e-6;
      const double high = plane.residual(detail::moved(s, step, {}));
      const double low = plane.residual(detail::moved(s, -step, {}));
      EXPECT_NEAR(jacobian[k], (high - low) / 2e-6, 2e-5) << k;
    }
  }
}

TEST(PlaneCost, MarginalDilationIsTheCostAtTheBestDilation) {
  Random random(6);
  const Superquadric s = random.superquadric();
  detail::PlaneCost cost;
  cost.dilation_sigma = 0.004;
  for (int i = 0; i < 20; ++i) {
    TangentPlane plane;
    plane.normal = random.direction();
    plane.offset = plane.normal.dot(s.center) + s.support(plane.normal) +
                   random.normal(0.002) - 0.003;
    plane.sigma = 0.002;
    cost.silhouette.push_back(plane);
  }
  detail::NormalEquations e;
  addExactly(cost, s, e);
  double best = 1e300;
  for (double b = -0.01; b < 0.01; b += 1e-6) {
    double c = b * b / (cost.dilation_sigma * cost.dilation_sigma);
    for (const TangentPlane& plane : cost.silhouette)
      c += std::pow((plane.residual(s) + b) / plane.sigma, 2);
    best = std::min(best, c);
  }
  EXPECT_NEAR(e.cost, best, 1e-3 * best);
}

TEST(PlaneCost, GradientAgreesWithCentralDifferences) {
  Random random(7);
  Superquadric s = random.superquadric();
  s.epsilon1 = s.epsilon2 = 0.8;
  detail::PlaneCost cost;
  cost.dilation_sigma = 0.01;
  const auto plane = [&](double offset) {
    TangentPlane p;
    p.normal = random.direction();
    p.offset = p.normal.dot(s.center) + s.support(p.normal) + offset;
    p.sigma = 0.01;
    return p;
  };
  for (int i = 0; i < 10; ++i)
    cost.silhouette.push_back(plane(random.normal(0.01)));
  cost.tangents = {plane(0.01)};
  cost.limits = {plane(-0.02), plane(0.02)}; // the second is not violated
  detail::NormalEquations e;
  addExactly(cost, s, e);
  for (int k = 0; k < 11; ++k) {
    detail::Vector11 step = detail::Vector11::Zero();
    step[k] = 1e-6;
    detail::NormalEquations high, low;
    addExactly(cost, detail::moved(s, step, {}), high);
    addExactly(cost, detail::moved(s, -step, {}), low);
    const double slope = (high.cost - low.cost) / 2e-6;
    EXPECT_NEAR(2.0 * e.jtr[k], slope, 1e-3 * (1.0 + std::abs(slope))) << k;
  }
}

TEST(PlaneSums, AreThoseOfTheCostPlaneByPlane) {
  Random random(8);
  for (int trial = 0; trial < 40; ++trial) {
    Superquadric s = random.superquadric();
    s.center = 0.3 * random.direction();
    s.semi_axes = {
        random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)};
    detail::PlaneCost cost;
    cost.unit = 0.02;
    cost.dilation_sigma = trial % 3 == 0 ? 0.0 : 0.01;
    const auto plane = [&] {
      TangentPlane p;
      p.normal = random.direction();
      p.offset = p.normal.dot(s.center) + s.support(p.normal) + random.normal(0.05);
      p.sigma = random.uniform(0.01, 0.03);
      return p;
    };
    // none, a few, more than one block of the kernels
    for (int i = 0; i < trial % 4 * 60; ++i)
      cost.silhouette.push_back(plane());
    for (int i = 0; i < 30; ++i) {
      cost.tangents.push_back(plane());
      cost.limits.push_back(plane());
    }
    cost.view = random.direction();
    cost.half_width = random.uniform(0.3, 2);
    detail::NormalEquations expected, e;
    addExactly(cost, s, expected);
    detail::PlaneSums sums(cost);
    sums(s, e);
    EXPECT_NEAR(e.cost, expected.cost, 1e-4 * expected.cost);
    for (int i = 0; i < 11; ++i) {
      const double scale = std::sqrt(expected.jtj(i, i));
      EXPECT_NEAR(e.jtr[i], expected.jtr[i], 1e-4 * scale * std::sqrt(expected.cost));
      for (int j = 0; j < 11; ++j)
        EXPECT_NEAR(e.jtj(i, j),
                    expected.jtj(i, j),
                    1e-4 * scale * std::sqrt(expected.jtj(j, j)));
    }
  }
}
