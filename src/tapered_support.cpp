// SPDX-License-Identifier: BSD-3-Clause
#include "tapered_support.h"

#include "damped_solve.h"
#include "shape_spaces.h"
#include "taper_support.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int ITERATIONS = 20;
constexpr double MIN_DAMPING = 1e-9, MAX_DAMPING = 1e8;

/** \brief A family's space with the taper's columns behind it. */
auto withTaper(const ParameterSpace& space, bool round) {
  const Eigen::Index own = space.basis.cols(), taper = round ? 1 : 2;
  decltype(TaperStart::basis) basis = decltype(basis)::Zero(13, own + taper);
  basis.topLeftCorner(11, own) = space.basis;
  basis(11, own) = 1.0;
  basis(12, own + taper - 1) = 1.0;
  return basis;
}

} // namespace

TaperStart taperStart(const SupportProblem& problem, const ShapeCandidate& c, int k) {
  TaperStart start;
  start.from = c;
  start.family = c.shape == ShapeClass::TAPERED ? c.before : c.shape;
  const bool round = start.family == ShapeClass::ROTATIONAL;
  start.from.model = withAxis(c.model, k);
  start.taper = round ? 1 : 2;
  ParameterSpace space = spaceOf(start.family);
  for (int axis = 0; axis < 3 && c.upright; ++axis)
    if (std::abs(start.from.model.rotation.col(axis).dot(problem.up())) > UPRIGHT)
      space = standing(space, axis);
  start.basis = withTaper(space, round);
  return start;
}

TaperedSupport::TaperedSupport(const SupportProblem& problem,
                               const UnitPoints& points,
                               double sigma)
    : problem_(problem), points_(points), limits_(problem.limits(sigma)),
      planes_(problem.planes(sigma, points)) {}

double TaperedSupport::gainOf(const TaperStart& start) const {
  TaperedSuperquadric s;
  s.shape = start.from.model;
  const Sums sums = evaluate(s);
  const int all = static_cast<int>(start.basis.cols());
  return promised(s, sums, start.basis, all) -
         promised(s, sums, start.basis, all - start.taper);
}

ShapeCandidate TaperedSupport::fit(const TaperStart& start) const {
  TaperedSuperquadric s;
  s.shape = start.from.model;
  s.kx = start.from.kx;
  s.ky = start.from.ky;
  const double cost = minimise(s, start.basis);
  ShapeCandidate c;
  c.shape = ShapeClass::TAPERED;
  c.before = start.family;
  c.upright = start.from.upright;
  c.parameters = static_cast<int>(start.basis.cols());
  c.cost = cost / (planes_.unit * planes_.unit);
  c.bic = c.cost + c.parameters * std::log(problem_.observations()) + TAPER;
  c.model = s.shape;
  c.kx = s.kx;
  c.ky = s.ky;
  return c;
}

TaperedSupport::Sums TaperedSupport::evaluate(const TaperedSuperquadric& model) const {
  Sums sums;
  const kernels::Points points = points_.view();
  const double s = 0.5 / (limits_.sigma * limits_.sigma), c = limits_.outlier;
  for (std::size_t i = 0; i < points.count; ++i) {
    const TaperRow row = taperRow(model, points_[i].cast<double>());
    const double q = points.precision ? double(points.precision[i]) : 1.0;
    const double square = q * row.residual * row.residual;
    double share = 1.0, cost = square;
    if (c > 0.0) {
      const double density = std::exp(-s * square);
      share = density / (density + c);
      cost = (std::log1p(c) - std::log(density + c)) / s;
    }
    sums.cost += cost;
    sums.jtj.selfadjointView<Eigen::Lower>().rankUpdate(row.derivatives, share * q);
    sums.jtr += share * q * row.residual * row.derivatives;
  }
  sums.jtj.triangularView<Eigen::StrictlyUpper>() = sums.jtj.transpose();
  const auto row = [&](const Eigen::Vector3d& n) { return taperSupport(model, n); };
  const auto reach = [&](const Eigen::Vector3d& n) {
    return n.dot(model.shape.center) + model.support(n);
  };
  addSupportCost<13>(planes_, row, reach, sums);
  return sums;
}

double TaperedSupport::step(const TaperedSuperquadric& s,
                            const Sums& sums,
                            const Basis& basis,
                            int columns,
                            double damping,
                            Vector13& full) const {
  const auto used = basis.leftCols(columns);
  Matrix13 jtj = Matrix13::Zero();
  Vector13 jtr = Vector13::Zero(), free = Vector13::Zero();
  jtj.topLeftCorner(columns, columns) = used.transpose() * sums.jtj * used;
  jtr.head(columns) = used.transpose() * sums.jtr;
  bool frozen[13] = {};
  for (int i = 0; i < columns; ++i)
    frozen[i] = leadsOut(s, Vector13(-jtr[i] * used.col(i)), limits_);
  if (!dampedSolve<13>(jtj, jtr, columns, frozen, damping, free))
    return -1.0;
  full = used * free.head(columns);
  return -jtr.head(columns).dot(free.head(columns));
}
double TaperedSupport::promised(const TaperedSuperquadric& s,
                                const Sums& sums,
                                const Basis& basis,
                                int columns) const {
  constexpr double DAMPING = 1e-3;
  Vector13 unused;
  const double gain = step(s, sums, basis, columns, DAMPING, unused);
  return std::max(gain, 0.0) / (planes_.unit * planes_.unit);
}

double TaperedSupport::minimise(TaperedSuperquadric& s, const Basis& basis) const {
  Sums sums = evaluate(s);
  double damping = limits_.initial_damping;
  for (int k = 0; k < ITERATIONS && damping < MAX_DAMPING; ++k) {
    Vector13 full;
    const double promise =
        step(s, sums, basis, static_cast<int>(basis.cols()), damping, full);
    if (promise >= 0.0) {
      bool limited = false;
      const double negligible = limits_.cost_tolerance * sums.cost;
      if (damping <= 1.0 && promise <= negligible)
        break;
      const TaperedSuperquadric candidate = moved(s, full, limits_, limited);
      const Sums next = evaluate(candidate);
      if (next.cost < sums.cost) {
        const bool small = !limited && sums.cost - next.cost <= negligible;
        s = candidate;
        sums = next;
        damping = std::max(0.2 * damping, MIN_DAMPING);
        if (small)
          break;
        continue;
      }
    }
    damping *= 6.0;
  }
  return sums.cost;
}

} // namespace pcl_sq::detail
