// SPDX-License-Identifier: BSD-3-Clause
// Private. The least-squares loop of all fits: Levenberg-Marquardt with Marquardt's
// scaling, bounds by freezing, over a subspace of the parameters.
#pragma once

#include "pcl_sq/fit_superquadric.h"
#include "solver/damped_solve.h"

#include <algorithm>
#include <limits>

namespace pcl_sq::detail {

/** \brief A fit that is not worth its time: what only the best of several is wanted
 * for may end where it is still far from another's cost after a few iterations. */
struct Hopeless {
  int after = 0; ///< iterations
  double cost = std::numeric_limits<double>::infinity();
};

/** \brief When the loop ends. */
struct LmLimits {
  int max_iterations = 30;
  /** \brief Of a cost, what changes by rounding alone; above 0 only small steps end the
   * fit: near a minimum costs of residuals in single precision differ by less than
   * their rounding, which the points' order changes, while the gradient still shows the
   * way. Steps that promise less than the rounding are then taken, whatever the cost.
   */
  double cost_rounding = 0.0;
  double cost_tolerance = 1e-7; ///< relative decrease that ends the fit
  double step_tolerance = 1e-6; ///< largest parameter change that ends the fit
  double initial_damping = 1e-3;
  Hopeless hopeless;
};

/** \brief Directions in which a fit of N parameters may move: a step is
 * basis * (free step). */
template <int N>
using Basis = Eigen::Matrix<double, N, Eigen::Dynamic, 0, N, N>;

/** \brief Equations along the columns of a basis. They have few entries, mostly one of
 * one: sums over those are as good as products of matrices, and quicker. */
template <int N>
class Along {
public:
  explicit Along(const Basis<N>& basis) : columns_(static_cast<int>(basis.cols())) {
    for (int c = 0; c < columns_; ++c)
      for (int i = 0; i < N; ++i)
        if (basis(i, c) != 0.0) {
          rows_[c][counts_[c]] = i;
          values_[c][counts_[c]++] = basis(i, c);
        }
  }

  /** \param[in] whole symmetric \param[out] part its lower half is filled */
  void reduce(const Eigen::Matrix<double, N, N>& whole,
              Eigen::Matrix<double, N, N>& part) const {
    for (int a = 0; a < columns_; ++a)
      for (int b = a; b < columns_; ++b) {
        double sum = 0.0;
        for (int i = 0; i < counts_[a]; ++i)
          for (int k = 0; k < counts_[b]; ++k)
            sum += values_[a][i] * values_[b][k] * whole(rows_[a][i], rows_[b][k]);
        part(b, a) = sum;
      }
  }
  void reduce(const Eigen::Matrix<double, N, 1>& whole,
              Eigen::Matrix<double, N, 1>& part) const {
    for (int a = 0; a < columns_; ++a) {
      part[a] = 0.0;
      for (int i = 0; i < counts_[a]; ++i)
        part[a] += values_[a][i] * whole[rows_[a][i]];
    }
  }
  /** \brief The whole step of steps along the columns. */
  Eigen::Matrix<double, N, 1> whole(const Eigen::Matrix<double, N, 1>& part) const {
    Eigen::Matrix<double, N, 1> step = Eigen::Matrix<double, N, 1>::Zero();
    for (int a = 0; a < columns_; ++a)
      for (int i = 0; i < counts_[a]; ++i)
        step[rows_[a][i]] += values_[a][i] * part[a];
    return step;
  }

private:
  int columns_;
  int counts_[N] = {};
  int rows_[N][N];
  double values_[N][N];
};

/** \brief A minimum, and how it was reached. \tparam Problem see minimiseSquares() */
template <typename Problem>
struct LmSummary {
  typename Problem::Model model;
  typename Problem::Equations equations; ///< at the model
  double damping = 0.0;                  ///< with which a further fit may go on
  int iterations = 0;
  Termination termination = Termination::NOT_RUN;
};

/** \brief Minimises a sum of squares from a start within the bounds (M13).
 *
 * \tparam Problem has a constant N, types Model and Equations (jtj, jtr, cost, and
 * points_cost, the part of the cost that tolerances refer to), and
 * - Equations evaluate(const Model&) const
 * - Model moved(const Model&, const Matrix<N, 1>& step, bool& limited) const: the model
 *   after a step that is held in the bounds and, which \a limited tells, in the range
 * of trust
 * - bool isActiveBound(const Model&, const Matrix<N, 1>& direction) const: whether a
 *   direction leads out of a bound that the model already touches
 * - double rounding() const: what rounding alone changes in a cost */
template <typename Problem>
LmSummary<Problem> minimiseSquares(const Problem& problem,
                                   const typename Problem::Model& start,
                                   const Basis<Problem::N>& basis,
                                   const LmLimits& limits) {
  constexpr double MIN_DAMPING = 1e-9, MAX_DAMPING = 1e8;
  constexpr double DAMPING_DOWN = 0.2, DAMPING_UP = 6.0;
  constexpr int N = Problem::N;
  LmSummary<Problem> r;
  r.model = start;
  r.equations = problem.evaluate(start);
  r.termination = Termination::MAX_ITERATIONS;
  const int n = std::min(N, static_cast<int>(basis.cols()));
  const Along<N> along(basis);
  const bool by_steps = limits.cost_rounding > 0.0;
  double damping = limits.initial_damping;
  bool fresh = true; // the equations changed since they were last reduced
  Eigen::Matrix<double, N, N> jtj;
  Eigen::Matrix<double, N, 1> jtr, step;
  bool frozen[N] = {};
  while (r.iterations < limits.max_iterations) {
    if (r.iterations >= limits.hopeless.after &&
        r.equations.cost > limits.hopeless.cost) {
      r.termination = Termination::GIVEN_UP;
      break;
    }
    if (fresh) {
      along.reduce(r.equations.jtj, jtj);
      along.reduce(r.equations.jtr, jtr);
      for (int i = 0; i < n; ++i)
        frozen[i] = problem.isActiveBound(r.model, -jtr[i] * basis.col(i));
      fresh = false;
    }
    ++r.iterations;
    if (dampedSolve(jtj, jtr, n, frozen, damping, step)) {
      // what the model itself promises; not worth an evaluation once it is nothing
      const double promised = -jtr.head(n).dot(step.head(n));
      const double negligible =
          limits.cost_tolerance * r.equations.points_cost + problem.rounding();
      if (!by_steps && damping <= 1.0 && promised <= negligible) {
        r.termination = Termination::COST_CHANGE_TOO_SMALL;
        break;
      }
      const Eigen::Matrix<double, N, 1> full = along.whole(step);
      bool limited = false;
      const typename Problem::Model candidate = problem.moved(r.model, full, limited);
      const bool short_step = full.cwiseAbs().maxCoeff() <= limits.step_tolerance;
      if (by_steps && short_step) {
        r.termination = Termination::STEP_TOO_SMALL;
        break;
      }
      const typename Problem::Equations e = problem.evaluate(candidate);
      const double rounding = limits.cost_rounding * r.equations.cost;
      const double slack = promised < rounding ? rounding : 0.0;
      if (e.cost < r.equations.cost + slack) {
        const double decrease = r.equations.cost - e.cost;
        const bool small = !by_steps && !limited && decrease <= negligible;
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
      if (short_step) {
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
  r.damping = std::clamp(damping, MIN_DAMPING, limits.initial_damping);
  return r;
}

} // namespace pcl_sq::detail
