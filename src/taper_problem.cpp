// SPDX-License-Identifier: BSD-3-Clause
#include "taper_problem.h"

#include "damped_solve.h"
#include "taper_step.h"

#include <Eigen/Cholesky>

namespace pcl_sq::detail {

namespace {

constexpr double MIN_DAMPING = 1e-9;
constexpr double MAX_DAMPING = 1e8;
constexpr double SHRINKAGE = 0.2; ///< of sigma in a round, at most
constexpr double SETTLED = 0.01;  ///< relative change of sigma that ends the rounds

} // namespace

TaperProblem::TaperProblem(const UnitPoints& points,
                           const FitSetting& setting,
                           double area)
    : setting_(setting), area_(area) {
  points_.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points_.push_back(points[i].cast<double>());
}

TaperProblem::Equations TaperProblem::evaluate(const TaperedSuperquadric& model,
                                               const Mixture& mixture) const {
  Equations e;
  const double s = 0.5 / (mixture.sigma * mixture.sigma);
  const double c = mixture.outlier(area_);
  const double log_full = std::log1p(c);
  for (const Eigen::Vector3d& p : points_) {
    const TaperRow row = taperRow(model, p);
    const double square = row.residual * row.residual;
    double share = 1.0, cost = square;
    if (c > 0.0) {
      const double density = std::exp(-s * square);
      share = density / (density + c);
      cost = (log_full - std::log(density + c)) / s;
    }
    e.sums.points_cost += cost;
    e.sums.share += share;
    e.sums.weighted += share * square;
    e.jtj.selfadjointView<Eigen::Lower>().rankUpdate(row.derivatives, share);
    e.jtr += share * row.residual * row.derivatives;
  }
  e.jtj.triangularView<Eigen::StrictlyUpper>() = e.jtj.transpose();
  e.sums.cost = e.sums.points_cost;
  if (setting_.size_prior) {
    sizePrior(mixture.sigma,
              (1.0 - mixture.outlier_share) * double(size()))(model.shape, e.sums);
    e.jtj.topLeftCorner<11, 11>() += e.sums.jtj;
    e.jtr.head<11>() += e.sums.jtr;
  }
  return e;
}

TaperProblem::Equations TaperProblem::minimise(TaperedSuperquadric& model,
                                               const Mixture& mixture,
                                               bool free,
                                               int iterations,
                                               double tolerance) const {
  const LmOptions& o = setting_.lm;
  const int n = free ? 13 : 11;
  Equations e = evaluate(model, mixture);
  double damping = o.initial_damping;
  for (int k = 0; k < iterations && damping < MAX_DAMPING; ++k) {
    bool frozen[13] = {};
    for (int i = 0; i < n; ++i)
      frozen[i] = leadsOut(model, Vector13(-e.jtr[i] * Vector13::Unit(i)), o);
    Vector13 step = Vector13::Zero();
    bool limited = false;
    if (dampedSolve<13>(e.jtj, e.jtr, n, frozen, damping, step)) {
      const TaperedSuperquadric candidate = moved(model, step, o, limited);
      const Equations next = evaluate(candidate, mixture);
      if (next.sums.cost < e.sums.cost) {
        const double decrease = e.sums.cost - next.sums.cost;
        const bool small = !limited && decrease <= tolerance * e.sums.points_cost;
        model = candidate;
        e = next;
        damping = std::max(0.2 * damping, MIN_DAMPING);
        if (small)
          break;
        continue;
      }
    }
    damping *= 6.0;
  }
  return e;
}

TaperCandidate TaperProblem::anneal(
    TaperCandidate c, bool free, int rounds, int iterations, double tolerance) const {
  for (int k = 0; k < rounds; ++k) {
    const Equations e = minimise(c.model, c.mixture, free, iterations, tolerance);
    const double before = c.mixture.sigma;
    c.mixture = estimated(c.mixture, e.sums, size(), setting_.limits);
    c.mixture.sigma = std::max(c.mixture.sigma, SHRINKAGE * before);
    if (std::abs(c.mixture.sigma - before) < SETTLED * before)
      break;
  }
  const Equations e = evaluate(c.model, c.mixture);
  c.nll = c.mixture.negativeLogLikelihood(e.sums.points_cost, size(), area_);
  c.model.shape.rotation =
      Eigen::Quaterniond(c.model.shape.rotation).normalized().toRotationMatrix();
  return c;
}

Eigen::Vector2d TaperProblem::taperDeviations(const TaperCandidate& c) const {
  Matrix13 information = evaluate(c.model, c.mixture).jtj;
  const double largest = information.diagonal().maxCoeff();
  if (!(largest > 0.0))
    return Eigen::Vector2d::Zero();
  const Vector13 size =
      information.diagonal().cwiseMax(1e-12 * largest).cwiseSqrt().cwiseInverse();
  information = size.asDiagonal() * information * size.asDiagonal();
  information.diagonal().array() += 1e-9; // a direction that nothing determines
  const Matrix13 inverse = information.ldlt().solve(Matrix13::Identity());
  return c.mixture.sigma * size.tail<2>().cwiseProduct(
                               inverse.diagonal().tail<2>().cwiseAbs().cwiseSqrt());
}

double TaperProblem::rmsDistance(const TaperedSuperquadric& model) const {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points_)
    sum += std::pow(taperRow(model, p).residual, 2);
  return std::sqrt(sum / double(size()));
}

} // namespace pcl_sq::detail
