// SPDX-License-Identifier: BSD-3-Clause
// Ceres, with derivatives by differences, from the same start: our minimum is not
// worse.
#include "solver/levenberg_marquardt.h"

#include "random_superquadric.h"

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::detail;
using pcl_sq::test::Random;

namespace {

/** \brief Radial distances of points, as a function of a step from the start. */
class RadialDistances : public ceres::CostFunction {
public:
  RadialDistances(const Superquadric& start, const std::vector<Eigen::Vector3d>& points)
      : start_(start), points_(points) {
    set_num_residuals(static_cast<int>(points.size()));
    mutable_parameter_block_sizes()->push_back(11);
  }
  Superquadric at(const double* x) const {
    return moved(start_, Eigen::Map<const Vector11>(x), LmOptions());
  }
  bool Evaluate(const double* const* parameters,
                double* residuals,
                double** jacobians) const override {
    fill(parameters[0], residuals);
    if (!jacobians || !jacobians[0])
      return true;
    constexpr double STEP = 1e-6;
    const auto n = points_.size();
    std::vector<double> forth(n), back(n);
    for (int k = 0; k < 11; ++k) {
      Vector11 x = Eigen::Map<const Vector11>(parameters[0]);
      x[k] += STEP;
      fill(x.data(), forth.data());
      x[k] -= 2.0 * STEP;
      fill(x.data(), back.data());
      for (std::size_t i = 0; i < n; ++i)
        jacobians[0][11 * i + static_cast<std::size_t>(k)] =
            (forth[i] - back[i]) / (2.0 * STEP);
    }
    return true;
  }

private:
  void fill(const double* x, double* residuals) const {
    const Superquadric s = at(x);
    for (std::size_t i = 0; i < points_.size(); ++i)
      residuals[i] = s.radialDistance(points_[i]);
  }
  Superquadric start_;
  const std::vector<Eigen::Vector3d>& points_;
};

double cost(const Superquadric& s, const std::vector<Eigen::Vector3d>& points) {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points)
    sum += std::pow(s.radialDistance(p), 2);
  return sum;
}

/** \brief What Ceres makes of it. */
Superquadric ceresMinimum(const Superquadric& start,
                          const std::vector<Eigen::Vector3d>& points) {
  double x[11] = {};
  ceres::Problem problem;
  auto* distances = new RadialDistances(start, points); // the problem takes it over
  problem.AddResidualBlock(distances, nullptr, x);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 300;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return distances->at(x);
}

struct Case {
  const char* name;
  double noise;
  bool partial; ///< only what lies on one side of the centre
  double off;   ///< largest distance of the start from the truth in each parameter
};

/** \brief For the test's name; bytes would be printed otherwise. */
void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

class CeresOracle : public testing::TestWithParam<Case> {};

} // namespace

TEST_P(CeresOracle, OurMinimumIsNotWorseFromTheSameStart) {
  const Case& c = GetParam();
  Random random(1);
  constexpr int TRIALS = 60;
  int same = 0;
  for (int trial = 0; trial < TRIALS; ++trial) {
    Superquadric truth;
    truth.center = 0.2 * random.direction();
    truth.rotation = random.rotation();
    truth.semi_axes = {
        random.uniform(0.5, 0.8), random.uniform(0.8, 1.2), random.uniform(1.2, 1.6)};
    truth.epsilon1 = random.uniform(0.3, 1.6);
    truth.epsilon2 = random.uniform(0.3, 1.6);
    const Eigen::Vector3d side = random.direction();
    std::vector<Eigen::Vector3d> points;
    UnitPoints unit;
    unit.reserve(300);
    while (unit.size() < 300) {
      const Eigen::Vector3d on_surface = random.surfacePoint(truth);
      if (c.partial && side.dot(on_surface - truth.center) < 0.0)
        continue;
      const Eigen::Vector3f p =
          (on_surface + c.noise * random.normal() * random.direction()).cast<float>();
      unit.add(p[0], p[1], p[2]);
      points.push_back(p.cast<double>());
    }
    Vector11 off;
    for (int k = 0; k < 11; ++k)
      off[k] = random.uniform(-c.off, c.off);
    const Superquadric start = moved(truth, off, LmOptions());

    LmOptions o;
    o.max_iterations = 300;
    o.cost_tolerance = 1e-12;
    o.step_tolerance = 1e-9;
    const LmResult ours = levenbergMarquardt(unit, start, o);
    // exact points leave the rounding of single precision
    const double rounding = 1e-12 * double(points.size());
    const double our_cost = cost(ours.model, points);
    const double other_cost = cost(ceresMinimum(start, points), points);
    EXPECT_LE(our_cost, other_cost * (1.0 + 1e-6) + rounding) << "trial " << trial;
    same += other_cost <= our_cost * (1.0 + 1e-6) + rounding;
  }
  EXPECT_GE(same, 0.9 * TRIALS) << "an oracle that finds no minimum proves nothing";
}

INSTANTIATE_TEST_SUITE_P(
    FullAndPartial,
    CeresOracle,
    testing::Values(Case{"Exact", 0.0, false, 0.1},
                    Case{"Noisy", 0.03, false, 0.1},
                    Case{"NoisyFromFarAway", 0.03, false, 0.3},
                    Case{"PartialExact", 0.0, true, 0.1},
                    Case{"PartialWithLittleNoise", 0.01, true, 0.1},
                    Case{"PartialNoisyFromFarAway", 0.03, true, 0.2}),
    [](const testing::TestParamInfo<Case>& tested) { return tested.param.name; });
