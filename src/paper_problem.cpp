// SPDX-License-Identifier: BSD-3-Clause
#include "paper_problem.h"

#include <cmath>

namespace pcl_sq::detail {

PaperProblem::PaperProblem(const UnitPoints& points,
                           const Superquadric& start,
                           int free_axis,
                           const PaperFitOptions& options)
    : points_(points), start_(start), free_axis_(free_axis), cost_(options.cost) {
  const double a = start.semi_axes[free_axis];
  lower_ << options.min_epsilon, options.min_epsilon,
      std::log(a * options.min_depth_ratio);
  upper_ << options.max_epsilon, options.max_epsilon,
      std::log(a * options.max_depth_ratio);
}

Eigen::Vector3d PaperProblem::parametersOf(const Superquadric& s) const {
  return {s.epsilon1, s.epsilon2, std::log(s.semi_axes[free_axis_])};
}

Superquadric PaperProblem::superquadricAt(const Eigen::Vector3d& x) const {
  Superquadric s = start_;
  s.epsilon1 = x[0];
  s.epsilon2 = x[1];
  s.semi_axes[free_axis_] = std::exp(x[2]);
  return s;
}

Eigen::Vector3d PaperProblem::clamp(const Eigen::Vector3d& x) const {
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

bool PaperProblem::pushesOutwards(const Eigen::Vector3d& x,
                                  const Eigen::Vector3d& gradient,
                                  int k) const {
  return (x[k] <= lower_[k] && gradient[k] > 0.0) ||
         (x[k] >= upper_[k] && gradient[k] < 0.0);
}

PaperProblem::Normal PaperProblem::linearise(const Eigen::Vector3d& x) const {
  const Superquadric s = superquadricAt(x);
  kernels::Residual residual = kernels::Residual::RADIAL;
  double factor = 1.0;        // of the squared residuals
  double factor_slope = 0.0;  // d ln sqrt(factor) / d ln a_free
  if (cost_ == Cost::PAPER) { // Eqs. (6), (7)
    residual = kernels::Residual::GAUGE;
    factor = std::sqrt(s.semi_axes.prod());
    factor_slope = 0.25;
  } else if (cost_ == Cost::SOLINA) {
    residual = kernels::Residual::SOLINA;
    factor = s.semi_axes.prod();
    factor_slope = 0.5;
  }
  kernels::Sums sums;
  kernels::kernels().normalEquations(
      points_.view(), toShape(s), residual, kernels::Mixture(), sums);
  // J = (column of e1, of e2, of ln a_free + slope * residual): three rows of the sums
  constexpr int RESIDUAL = kernels::PARAMETERS;
  const int columns[3] = {9, 10, 6 + free_axis_};
  const auto product = [&sums](int i, int j) {
    return i < j ? sums.products[i][j] : sums.products[j][i];
  };
  const auto slope = [&](int k) { return k == 2 ? factor_slope : 0.0; };
  const double rr = sums.products[RESIDUAL][RESIDUAL];
  const double scale = factor / double(points_.size());
  Normal normal;
  normal.cost = scale * rr;
  for (int i = 0; i < 3; ++i) {
    const double ir = product(columns[i], RESIDUAL);
    normal.gradient[i] = scale * (ir + slope(i) * rr);
    for (int j = 0; j < 3; ++j)
      normal.hessian(i, j) =
          scale * (product(columns[i], columns[j]) + slope(j) * ir +
                   slope(i) * product(columns[j], RESIDUAL) + slope(i) * slope(j) * rr);
  }
  return normal;
}

} // namespace pcl_sq::detail
