// SPDX-License-Identifier: BSD-3-Clause
// Private. Least squares of points over the parameters of a superquadric: the paper's
// eleven by the kernels, or those and the taper's two point by point; further costs
// from contributors.
#pragma once

#include "geometry/taper.h"
#include "solver/lm.h"

#include <functional>

namespace pcl_sq::detail {

using Vector11 = Eigen::Matrix<double, 11, 1>;
using Matrix11 = Eigen::Matrix<double, 11, 11>;

/** \brief A cost sum r^2 and its Gauss-Newton model; parameters in the order of
 * Superquadric::logGaugeJacobian(), t along the own axes, w, ln a, e1, e2, and kx, ky
 * where N is 13. */
template <int N>
struct SquareSums {
  Eigen::Matrix<double, N, N> jtj = Eigen::Matrix<double, N, N>::Zero();
  /** \brief Half the cost's gradient. */
  Eigen::Matrix<double, N, 1> jtr = Eigen::Matrix<double, N, 1>::Zero();
  double cost = 0.0;
  double points_cost = 0.0; ///< the points' part of the cost
  double share = 0.0;       ///< expected number of inliers
  double weighted = 0.0;    ///< sum of share r^2

  /** \brief Adds one residual with its derivatives. */
  void addRow(const Eigen::Matrix<double, N, 1>& derivatives, double residual) {
    jtj.noalias() += derivatives * derivatives.transpose();
    jtr += derivatives * residual;
    cost += residual * residual;
  }
};
using NormalEquations = SquareSums<11>;

/** \brief Adds a further cost of the superquadric, given in the frame of the points; in
 * squared lengths of that frame, as the residuals of the points. */
template <int N>
using ContributorOf = std::function<void(const Superquadric&, SquareSums<N>&)>;
using Contributor = ContributorOf<11>;

/** \brief The directions in which a fit of eleven parameters may move. */
struct ParameterSpace {
  Basis<11> basis = Matrix11::Identity();

  /** \brief All parameters but those whose bit is set (bit i: parameter i). */
  static ParameterSpace without(unsigned fixed);
  /** \brief Solids of revolution about z: a1 = a2, no spin; the start's e2 is kept. */
  static ParameterSpace rotational();
};

struct LmOptions : LmLimits {
  kernels::Residual residual = kernels::Residual::RADIAL;
  double sigma = 0.0;   ///< of the mixture's Gaussian; 0: plain least squares
  double outlier = 0.0; ///< the mixture's c, see kernels::Mixture
  double min_epsilon = Superquadric::MIN_EPSILON;
  double max_epsilon = Superquadric::MAX_EPSILON;
  double min_axis = 1e-5, max_axis = 1e3; ///< in the frame of the points
  ParameterSpace space;                   ///< of a fit of eleven parameters
  Contributor contributor; ///< to a fit of eleven parameters; may be empty
};

/** \brief Cost and Gauss-Newton model of the points alone; with thirteen parameters by
 * the distance to the foot point, whatever the options' residual. */
template <int N>
SquareSums<N>
sumsOf(const UnitPoints& points, const Superquadric& model, const LmOptions& options);

/** \brief The options' mixture for the kernels. */
kernels::Mixture mixtureOf(const LmOptions& options);

/** \brief What the kernels have summed up, by its name. */
template <int N, int R>
SquareSums<N> squaresOf(const kernels::SumsOf<R>& sums) {
  SquareSums<N> e;
  for (int i = 0; i < N; ++i) {
    for (int j = i; j < N; ++j)
      e.jtj(i, j) = e.jtj(j, i) = sums.products[i][j];
    e.jtr[i] = sums.products[i][N];
  }
  e.cost = e.points_cost = sums.cost;
  e.share = sums.share;
  e.weighted = sums.products[N][N];
  return e;
}

/** \brief Cost alone. */
double evaluateCost(const UnitPoints& points,
                    const Superquadric& model,
                    const LmOptions& options,
                    double* share = nullptr);

/** \brief A superquadric moved by a step; exponents, axes and taper held in their
 * bounds. */
Superquadric
moved(const Superquadric& model, const Vector11& step, const LmOptions& options);

/** \brief Points and further costs as minimiseSquares() wants them. */
template <int Parameters>
struct PointsProblem {
  static constexpr int N = Parameters;
  using Model = Superquadric;
  using Equations = SquareSums<Parameters>;
  using Vector = Eigen::Matrix<double, Parameters, 1>;

  const UnitPoints& points;
  const LmOptions& options;
  const ContributorOf<Parameters>& contributor;

  Equations evaluate(const Superquadric& model) const;
  /** \brief Shortens the parts of a step that leave the model's range of trust, each
   * for itself: the spin of a sphere may be anything, which must not hold up its
   * radius. Holds all in the bounds. */
  Superquadric
  moved(const Superquadric& model, const Vector& step, bool& limited) const;
  bool isActiveBound(const Superquadric& model, const Vector& direction) const;
  double rounding() const;
};

using LmResult = LmSummary<PointsProblem<11>>;

/** \brief Minimises sum of the points' costs plus the contributor's. The start must be
 * valid; it is moved into the bounds. */
LmResult levenbergMarquardt(const UnitPoints& points,
                            const Superquadric& start,
                            const LmOptions& options);

/** \brief The same over a basis of all thirteen parameters. */
LmSummary<PointsProblem<13>> fitTaperedBody(const UnitPoints& points,
                                            const Superquadric& start,
                                            const Basis<13>& basis,
                                            const LmOptions& options,
                                            const ContributorOf<13>& contributor);

} // namespace pcl_sq::detail
