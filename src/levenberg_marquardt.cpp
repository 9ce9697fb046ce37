// SPDX-License-Identifier: BSD-3-Clause
#include "levenberg_marquardt.h"

#include "damped_solve.h"

namespace pcl_sq::detail {

namespace {

constexpr double MIN_DAMPING = 1e-9;
constexpr double MAX_DAMPING = 1e8;
constexpr double DAMPING_DOWN = 0.2;
constexpr double DAMPING_UP = 6.0;
/** \brief A point's share in what rounding alone changes in a cost: single-precision
 * residuals of points of size one, squared. Exact points would else keep a fit busy. */
constexpr double ROUNDING = 1e-14;
constexpr double TRUST = 0.7; ///< largest step of an angle, a logarithm, an exponent

kernels::Mixture mixture(const LmOptions& o) {
  kernels::Mixture m;
  if (o.sigma > 0.0 && o.outlier > 0.0) {
    m.inverse_two_sigma_squared = static_cast<float>(0.5 / (o.sigma * o.sigma));
    m.outlier = static_cast<float>(std::clamp(o.outlier, 1e-12, 1e6));
  }
  return m;
}

NormalEquations evaluate(const UnitPoints& points,
                         const Superquadric& model,
                         const LmOptions& options) {
  NormalEquations e = normalEquations(points, model, options);
  if (options.contributor)
    options.contributor(model, e);
  return e;
}

} // namespace

bool leadsOut(const Superquadric& m, const Vector11& direction, const LmOptions& o) {
  for (int i = 6; i < 11; ++i) {
    const double value = i < 9 ? m.semi_axes[i - 6] : i == 9 ? m.epsilon1 : m.epsilon2;
    const double low = i < 9 ? o.min_axis : o.min_epsilon;
    const double high = i < 9 ? o.max_axis : o.max_epsilon;
    if ((value <= low && direction[i] < 0.0) || (value >= high && direction[i] > 0.0))
      return true;
  }
  return false;
}

bool limitStep(Vector11& step, const Superquadric& m) {
  bool limited = false;
  const auto shorten = [&](int begin, int size, double trust) {
    const double largest = step.segment(begin, size).cwiseAbs().maxCoeff();
    if (largest > trust) {
      step.segment(begin, size) *= trust / largest;
      limited = true;
    }
  };
  shorten(0, 3, TRUST * m.semi_axes.maxCoeff());
  shorten(3, 3, TRUST);
  shorten(6, 3, TRUST);
  shorten(9, 2, TRUST);
  return limited;
}

ParameterSpace ParameterSpace::without(unsigned fixed) {
  ParameterSpace space;
  int columns = 0;
  for (int i = 0; i < 11; ++i)
    if (!(fixed >> i & 1U))
      space.basis.col(columns++) = Vector11::Unit(i);
  space.basis.conservativeResize(11, columns);
  return space;
}

ParameterSpace ParameterSpace::rotational() {
  ParameterSpace space = without(1U << 5 | 1U << 7 | 1U << 10);
  space.basis.col(5)[7] = 1.0; // the column of ln a1 moves ln a2 as well
  return space;
}

NormalEquations normalEquations(const UnitPoints& points,
                                const Superquadric& model,
                                const LmOptions& options) {
  kernels::Sums sums;
  kernels::kernels().normalEquations(
      points.view(), toShape(model), options.residual, mixture(options), sums);
  NormalEquations e;
  for (int i = 0; i < 11; ++i) {
    for (int j = i; j < 11; ++j)
      e.jtj(i, j) = e.jtj(j, i) = sums.products[i][j];
    e.jtr[i] = sums.products[i][11];
  }
  e.cost = e.points_cost = sums.cost;
  e.share = sums.share;
  e.weighted = sums.products[11][11];
  return e;
}

double evaluateCost(const UnitPoints& points,
                    const Superquadric& model,
                    const LmOptions& options,
                    double* share) {
  kernels::Sums sums;
  kernels::kernels().evaluate(
      points.view(), toShape(model), options.residual, mixture(options), sums);
  if (share)
    *share = sums.share;
  return sums.cost;
}

Superquadric
moved(const Superquadric& model, const Vector11& step, const LmOptions& o) {
  Superquadric m = model;
  m.center += m.rotation * step.head<3>();
  const double angle = step.segment<3>(3).norm();
  if (angle > 0.0)
    m.rotation *=
        Eigen::AngleAxisd(angle, step.segment<3>(3) / angle).toRotationMatrix();
  for (int k = 0; k < 3; ++k)
    m.semi_axes[k] =
        std::clamp(m.semi_axes[k] * std::exp(step[6 + k]), o.min_axis, o.max_axis);
  m.epsilon1 = std::clamp(m.epsilon1 + step[9], o.min_epsilon, o.max_epsilon);
  m.epsilon2 = std::clamp(m.epsilon2 + step[10], o.min_epsilon, o.max_epsilon);
  return m;
}

LmResult levenbergMarquardt(const UnitPoints& points,
                            const Superquadric& start,
                            const LmOptions& o) {
  LmResult r;
  r.model = moved(start, Vector11::Zero(), o);
  r.equations = evaluate(points, r.model, o);
  r.termination = Termination::MAX_ITERATIONS;
  const auto& basis = o.space.basis;
  const int n = static_cast<int>(basis.cols());
  const bool all = n == 11 && basis.isIdentity(0.0);
  const double rounding = ROUNDING * double(points.size());
  double damping = o.initial_damping;
  bool fresh = true; // the equations changed since they were last reduced
  Matrix11 jtj;
  Vector11 jtr, step;
  bool frozen[11] = {};
  while (r.iterations < o.max_iterations) {
    if (r.iterations >= o.hopeless.after && r.equations.cost > o.hopeless.cost)
      break;
    if (fresh) {
      if (all) {
        jtj = r.equations.jtj;
        jtr = r.equations.jtr;
      } else {
        jtj.topLeftCorner(n, n).noalias() = basis.transpose() * r.equations.jtj * basis;
        jtr.head(n).noalias() = basis.transpose() * r.equations.jtr;
      }
      for (int i = 0; i < n; ++i)
        frozen[i] = leadsOut(r.model, -jtr[i] * basis.col(i), o);
      fresh = false;
    }
    ++r.iterations;
    const bool solved = dampedSolve(jtj, jtr, n, frozen, damping, step);
    if (solved) {
      // what the model itself promises; not worth an evaluation once it is nothing
      const double promised = -jtr.head(n).dot(step.head(n));
      const double negligible = o.cost_tolerance * r.equations.points_cost + rounding;
      if (damping <= 1.0 && promised <= negligible) {
        r.termination = Termination::COST_CHANGE_TOO_SMALL;
        break;
      }
      Vector11 full = basis * step.head(n);
      const bool limited = limitStep(full, r.model);
      const Superquadric candidate = moved(r.model, full, o);
      const NormalEquations e = evaluate(points, candidate, o);
      if (e.cost < r.equations.cost) {
        const double decrease = r.equations.cost - e.cost;
        const bool small = !limited && decrease <= negligible;
        r.model = candidate;
        r.equations = e;
        fresh = true;
        damping = std::max(damping * DAMPING_DOWN, MIN_DAMPING);
        if (small) {
          r.termination = Termination::COST_CHANGE_TOO_SMALL;
          break;
        }
        continue;
      }
      if (full.cwiseAbs().maxCoeff() <= o.step_tolerance) {
        r.termination = Termination::STEP_TOO_SMALL;
        break;
      }
    }
    damping *= DAMPING_UP;
    if (damping > MAX_DAMPING) {
      r.termination = Termination::DAMPING_TOO_LARGE;
      break;
    }
  }
  r.damping = std::clamp(damping, MIN_DAMPING, o.initial_damping);
  r.model.rotation =
      Eigen::Quaterniond(r.model.rotation).normalized().toRotationMatrix();
  return r;
}

} // namespace pcl_sq::detail
