// SPDX-License-Identifier: BSD-3-Clause
#include "paper_problem.h"

#include "gauge.h"

namespace pcl_sq::detail {

PaperProblem::LocalPoints
PaperProblem::toLocal(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const Superquadric& pose) {
  LocalPoints local;
  for (auto& coordinate : local.log_coordinate)
    coordinate.reserve(points.cols());
  local.radius.reserve(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite())
      continue;
    const Eigen::Vector3d y = pose.toLocal(points.col(i));
    for (int k = 0; k < 3; ++k)
      local.log_coordinate[k].push_back(
          float(std::log(std::max(std::abs(y[k]), TINY))));
    local.radius.push_back(float(y.norm()));
  }
  return local;
}

PaperProblem::PaperProblem(const LocalPoints& points,
                           const Superquadric& start,
                           int shift,
                           int free_axis,
                           const PaperFitOptions& options)
    : points_(points), start_(start), shift_(shift), free_axis_(free_axis),
      cost_(options.cost) {
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
  const Eigen::Vector3d log_axes = s.semi_axes.array().log();
  const double volume_factor = s.semi_axes.prod();
  const double paper_factor = std::sqrt(std::sqrt(volume_factor)); // root of Eq. (7)'s
  const double solina_factor = std::sqrt(volume_factor);
  const std::vector<float>& log_x = points_.log_coordinate[shift_ % 3];
  const std::vector<float>& log_y = points_.log_coordinate[(1 + shift_) % 3];
  const std::vector<float>& log_z = points_.log_coordinate[(2 + shift_) % 3];
  Normal normal;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    LogGauge g;
    const double log_h = logNorm(log_x[i] - log_axes.x(),
                                 log_y[i] - log_axes.y(),
                                 s.epsilon2,
                                 g.inner_x,
                                 g.inner_y,
                                 g.inner_entropy);
    g.value = logNorm(log_h,
                      log_z[i] - log_axes.z(),
                      s.epsilon1,
                      g.outer_h,
                      g.outer_z,
                      g.outer_entropy);
    const double shares[3] = {g.outer_h * g.inner_x, g.outer_h * g.inner_y, g.outer_z};
    const Eigen::Vector3d d_log_gauge(
        0.5 * g.outer_entropy, 0.5 * g.outer_h * g.inner_entropy, -shares[free_axis_]);
    const double gauge = std::exp(g.value);
    double residual = 0.0, slope = 0.0, axis_term = 0.0;
    switch (cost_) {
    case Cost::PAPER: // Eqs. (6), (7)
      residual = paper_factor * (gauge - 1.0);
      slope = paper_factor * gauge;
      axis_term = 0.25 * residual;
      break;
    case Cost::SOLINA: // F^e1 = G^2
      residual = solina_factor * (gauge * gauge - 1.0);
      slope = 2.0 * solina_factor * gauge * gauge;
      axis_term = 0.5 * residual;
      break;
    case Cost::RADIAL:
      residual = points_.radius[i] * (1.0 - 1.0 / gauge);
      slope = points_.radius[i] / gauge;
      break;
    }
    Eigen::Vector3d jacobian = slope * d_log_gauge;
    jacobian[2] += axis_term; // the volume factor moves with a_free
    normal.cost += residual * residual;
    normal.gradient += residual * jacobian;
    normal.hessian.noalias() += jacobian * jacobian.transpose();
  }
  const double scale = 1.0 / double(points_.size());
  normal.cost *= scale;
  normal.gradient *= scale;
  normal.hessian *= scale;
  return normal;
}

} // namespace pcl_sq::detail
