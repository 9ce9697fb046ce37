// SPDX-License-Identifier: BSD-3-Clause
#include "fit/full_fit.h"

#include <Eigen/Cholesky>

namespace pcl_sq {

namespace detail {

namespace {

constexpr std::size_t MIN_POINTS = 12;         ///< one more than parameters
constexpr std::size_t WORKING_POINTS = 16384;  ///< more do not change the mixture
constexpr std::size_t MEASURED_POINTS = 65536; ///< for the reported distances
constexpr double MAX_AXIS = 30.0;              ///< standard deviations of the cloud
constexpr double MIN_AXIS = 1e-4;
constexpr double FARTHEST = 1e6; ///< a start's centre; floats hold squares of it

/** \brief Inverse of the information in the free directions, in the cloud's unit. */
Eigen::Matrix<double, 11, 11>
covarianceOf(const LmResult& last, const LmOptions& o, double sigma, double scale) {
  const auto& basis = o.space.basis;
  std::vector<int> free;
  for (int k = 0; k < basis.cols(); ++k) {
    const Superquadric& m = last.model;
    const bool bounded = (basis(9, k) != 0.0 && (m.epsilon1 <= o.min_epsilon ||
                                                 m.epsilon1 >= o.max_epsilon)) ||
                         (basis(10, k) != 0.0 &&
                          (m.epsilon2 <= o.min_epsilon || m.epsilon2 >= o.max_epsilon));
    if (!bounded)
      free.push_back(k);
  }
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd b(11, n);
  for (Eigen::Index k = 0; k < n; ++k)
    b.col(k) = basis.col(free[static_cast<std::size_t>(k)]);
  Eigen::MatrixXd information = b.transpose() * last.equations.jtj * b;
  const double largest = n > 0 ? information.diagonal().maxCoeff() : 0.0;
  if (!(largest > 0.0))
    return Eigen::Matrix<double, 11, 11>::Zero();
  const Eigen::VectorXd size =
      information.diagonal().cwiseMax(1e-12 * largest).cwiseSqrt().cwiseInverse();
  information = size.asDiagonal() * information * size.asDiagonal();
  information.diagonal().array() += 1e-9; // a direction that nothing determines
  const Eigen::MatrixXd inverse =
      size.asDiagonal() * information.ldlt().solve(Eigen::MatrixXd::Identity(n, n)) *
      size.asDiagonal();
  Eigen::Matrix<double, 11, 11> covariance =
      sigma * sigma * b * inverse * b.transpose();
  covariance.topRows<3>() *= scale;
  covariance.leftCols<3>() *= scale;
  return covariance;
}

/** \brief The two figures that are reported for every fit. */
void addDistances(const UnitPoints& points,
                  const Superquadric& unit_model,
                  double scale,
                  FitSummary& summary) {
  LmOptions o;
  o.residual = kernels::Residual::FOOT_POINT;
  const double n = double(points.size());
  summary.rms_distance = scale * std::sqrt(evaluateCost(points, unit_model, o) / n);
  o.residual = kernels::Residual::GAUGE;
  summary.distortion = std::sqrt(summary.model.semi_axes.prod()) *
                       evaluateCost(points, unit_model, o) / n;
}

/** \brief A start's mixture from its residuals: half of the points are closer. */
Candidate
candidateAt(const UnitPoints& points, const Superquadric& start, const FitSetting& s) {
  Candidate c;
  c.model = moved(start, Vector11::Zero(), s.lm);
  c.mixture.volume = points.boxVolume();
  const UnitPoints few = subset(points, 512);
  std::vector<float> residuals(few.size());
  kernels::kernels().residuals(
      few.view(), toShape(c.model), kernels::Residual::FOOT_POINT, residuals.data());
  for (float& r : residuals)
    r = std::abs(r);
  const auto middle =
      residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  c.mixture.sigma = std::clamp(1.5 * double(*middle), 1e-4, 0.5);
  if (s.limits.fixed_sigma > 0.0)
    c.mixture.sigma = s.limits.fixed_sigma;
  if (!s.limits.robust)
    c.mixture.outlier_share = 0.0;
  return c;
}

} // namespace

FitSetting settingOf(const FitOptions& options, std::size_t count) {
  FitSetting s;
  s.lm.min_epsilon = options.min_epsilon;
  s.lm.max_epsilon = options.max_epsilon;
  s.lm.min_axis = MIN_AXIS;
  s.lm.max_axis = MAX_AXIS;
  s.lm.space = ParameterSpace::without(options.fixed);
  // a fiftieth of what one point more or less would change
  s.lm.cost_tolerance = 0.02 / double(count);
  s.limits.robust = options.robust;
  s.limits.max_outlier_share = options.max_outlier_share;
  s.size_prior = options.size_prior;
  s.max_iterations = options.max_iterations;
  return s;
}

namespace {

/** \brief fitSuperquadric(); \a initial nullptr: search. */
template <typename Points>
FitSummary
fitFull(const Points& points, const Superquadric* initial, const FitOptions& options) {
  FitSummary summary;
  const bool held = options.fixed != FIX_NOTHING;
  if (!options.isValid() || (held && !initial) || (initial && !initial->isValid())) {
    summary.termination = Termination::INVALID_OPTIONS;
    return summary;
  }
  Normalisation frame;
  summary.points = principalFrame(points, frame);
  if (summary.points < MIN_POINTS || isLine(frame)) {
    summary.termination = summary.points >= MIN_POINTS ? Termination::DEGENERATE
                                                       : Termination::TOO_FEW_POINTS;
    return summary;
  }
  if (initial && !(frame.toUnit(initial->center).norm() < FARTHEST)) {
    summary.termination = Termination::INVALID_OPTIONS;
    return summary;
  }
  const bool large = summary.points > MEASURED_POINTS;
  const UnitPoints all = large ? UnitPoints() : toUnit(points, frame);
  const UnitPoints part =
      large ? subsetInUnit(points, frame, summary.points, WORKING_POINTS)
            : subset(all, WORKING_POINTS);
  FitSetting setting = settingOf(options, part.size());
  setting.limits.fixed_sigma = options.noise / frame.scale;
  LmResult last;
  Candidate best;
  if (initial) {
    best = candidateAt(part, frame.toUnit(*initial), setting);
    best = refine(part, best, setting, last);
  } else {
    best = refine(part, search(part, nullptr, setting), setting, last);
    if (doubtful(part, best)) {
      LmResult other_last;
      const Candidate other =
          refine(part, search(part, &best.model, setting), setting, other_last);
      if (other.nll < best.nll) {
        best = other;
        last = other_last;
      }
    }
  }
  summary.model = frame.toCloud(best.model);
  summary.iterations = setting.iterations;
  summary.termination = last.termination;
  summary.sigma = best.mixture.sigma * frame.scale;
  summary.outlier_share = best.mixture.outlier_share;
  summary.covariance = covarianceOf(last, setting.lm, best.mixture.sigma, frame.scale);
  addDistances(large ? part : all, best.model, frame.scale, summary);
  return summary;
}

} // namespace

} // namespace detail

FitSummary fitSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const FitOptions& options) {
  return detail::fitFull(points, nullptr, options);
}

FitSummary fitSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const Superquadric& initial,
                           const FitOptions& options) {
  return detail::fitFull(points, &initial, options);
}

FitSummary fitSuperquadric(const CloudPoints& points, const FitOptions& options) {
  return detail::fitFull(points, nullptr, options);
}

FitSummary fitSuperquadric(const CloudPoints& points,
                           const Superquadric& initial,
                           const FitOptions& options) {
  return detail::fitFull(points, &initial, options);
}

} // namespace pcl_sq
