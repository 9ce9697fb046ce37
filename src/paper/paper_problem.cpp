// SPDX-License-Identifier: BSD-3-Clause
#include "paper/paper_problem.h"

#include <cmath>

namespace pcl_sq::detail {

PaperProblem::PaperProblem(const UnitPoints& points,
                           const Superquadric& start,
                           int free_axis,
                           const PaperFitOptions& options)
    : points_(points), start_(start), free_axis_(free_axis),
      keep_front_(options.keep_front), cost_(options.cost) {
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
  if (keep_front_)
    s.center += (s.semi_axes[free_axis_] - start_.semi_axes[free_axis_]) *
                s.rotation.col(free_axis_);
  return s;
}

Eigen::Vector3d PaperProblem::clamp(const Eigen::Vector3d& x) const {
  return x.cwiseMax(lower_).cwiseMin(upper_);
}

PaperProblem::Model
PaperProblem::moved(const Model& x, const Eigen::Vector3d& step, bool& limited) const {
  limited = false;
  return clamp(x + step);
}

bool PaperProblem::isActiveBound(const Model& x,
                                 const Eigen::Vector3d& direction) const {
  return ((x.array() <= lower_.array() && direction.array() < 0.0) ||
          (x.array() >= upper_.array() && direction.array() > 0.0))
      .any();
}

PaperProblem::Equations PaperProblem::evaluate(const Model& x) const {
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
  // J = (e1, e2, ln a_free [+ a_free d/d centre] + slope * residual): weighted columns
  using Weights = Eigen::Matrix<double, kernels::PARAMETERS + 1, 1>;
  constexpr int RESIDUAL = kernels::PARAMETERS;
  Eigen::Matrix<double, kernels::PARAMETERS + 1, 3> columns;
  columns.setZero();
  columns(9, 0) = 1.0;
  columns(10, 1) = 1.0;
  columns(6 + free_axis_, 2) = 1.0;
  columns(RESIDUAL, 2) = factor_slope;
  if (keep_front_)
    columns(free_axis_, 2) = s.semi_axes[free_axis_];
  const auto times = [&sums](const Weights& w) {
    Weights result;
    for (int i = 0; i <= RESIDUAL; ++i) {
      result[i] = 0.0;
      for (int j = 0; j <= RESIDUAL; ++j)
        result[i] += w[j] * (i < j ? sums.products[i][j] : sums.products[j][i]);
    }
    return result;
  };
  const double scale = factor / double(points_.size());
  Equations e;
  e.cost = e.points_cost = scale * sums.products[RESIDUAL][RESIDUAL];
  for (int i = 0; i < 3; ++i) {
    const Weights row = times(columns.col(i));
    e.jtr[i] = scale * row[RESIDUAL];
    for (int j = 0; j < 3; ++j)
      e.jtj(i, j) = scale * columns.col(j).dot(row);
  }
  return e;
}

} // namespace pcl_sq::detail
