// SPDX-License-Identifier: BSD-3-Clause
// Private. Levenberg-Marquardt over the eleven parameters of a superquadric; the sums
// over the points come from the kernels, further costs from contributors.
#pragma once

#include "pcl_sq/fit_superquadric.h"
#include "unit_frame.h"

#include <functional>
#include <limits>

namespace pcl_sq::detail {

using Vector11 = Eigen::Matrix<double, 11, 1>;
using Matrix11 = Eigen::Matrix<double, 11, 11>;

/** \brief A cost sum r^2 and its Gauss-Newton model; parameters in the order of
 * Superquadric::logGaugeJacobian(): t along the own axes, w, ln a, e1, e2. */
struct NormalEquations {
  Matrix11 jtj = Matrix11::Zero();
  Vector11 jtr = Vector11::Zero(); ///< half the cost's gradient
  double cost = 0.0;
  double points_cost = 0.0; ///< the points' part of the cost
  double share = 0.0;       ///< expected number of inliers
  double weighted = 0.0;    ///< sum of share r^2

  /** \brief Adds one residual with its derivatives. */
  void addRow(const Vector11& derivatives, double residual) {
    jtj.noalias() += derivatives * derivatives.transpose();
    jtr += derivatives * residual;
    cost += residual * residual;
  }
};

/** \brief Adds a further cost of the superquadric, given in the frame of the points; in
 * squared lengths of that frame, as the residuals of the points. */
using Contributor = std::function<void(const Superquadric&, NormalEquations&)>;

/** \brief The directions in which a fit may move: a step is basis * (free step). */
struct ParameterSpace {
  Eigen::Matrix<double, 11, Eigen::Dynamic, 0, 11, 11> basis = Matrix11::Identity();

  /** \brief All parameters but those whose bit is set (bit i: parameter i). */
  static ParameterSpace without(unsigned fixed);
  /** \brief Solids of revolution about z: a1 = a2, no spin; the start's e2 is kept. */
  static ParameterSpace rotational();
};

/** \brief A fit that is not worth its time: what only the best of several is wanted
 * for may end where it is still far from another's cost after a few iterations. */
struct Hopeless {
  int after = 0; ///< iterations
  double cost = std::numeric_limits<double>::infinity();
};

struct LmOptions {
  kernels::Residual residual = kernels::Residual::RADIAL;
  double sigma = 0.0;   ///< of the mixture's Gaussian; 0: plain least squares
  double outlier = 0.0; ///< the mixture's c, see kernels::Mixture
  int max_iterations = 30;
  double cost_tolerance = 1e-7; ///< relative decrease that ends the fit
  double step_tolerance = 1e-6; ///< largest parameter change that ends the fit
  double initial_damping = 1e-3;
  double min_epsilon = Superquadric::MIN_EPSILON;
  double max_epsilon = Superquadric::MAX_EPSILON;
  double min_axis = 1e-5, max_axis = 1e3; ///< in the frame of the points
  Hopeless hopeless;
  ParameterSpace space;
  Contributor contributor; ///< may be empty
};

struct LmResult {
  Superquadric model;
  NormalEquations equations; ///< at the model
  double damping = 0.0;      ///< with which a further fit may go on
  int iterations = 0;
  Termination termination = Termination::NOT_RUN;
};

/** \brief Cost and Gauss-Newton model of the points alone. */
NormalEquations normalEquations(const UnitPoints& points,
                                const Superquadric& model,
                                const LmOptions& options);

/** \brief Cost alone. */
double evaluateCost(const UnitPoints& points,
                    const Superquadric& model,
                    const LmOptions& options,
                    double* share = nullptr);

/** \brief A superquadric moved by a step; exponents and axes held in their bounds. */
Superquadric
moved(const Superquadric& model, const Vector11& step, const LmOptions& options);

/** \brief Whether a direction leads out of a bound that the model already touches. */
bool leadsOut(const Superquadric& model,
              const Vector11& direction,
              const LmOptions& options);

/** \brief Shortens the parts of a step that leave the model's range of trust, each for
 * itself: the spin of a sphere may be anything, which must not hold up its radius.
 * \return whether a part was shortened */
bool limitStep(Vector11& step, const Superquadric& model);

/** \brief Minimises sum of the points' costs plus the contributor's. The start must be
 * valid; it is moved into the bounds. */
LmResult levenbergMarquardt(const UnitPoints& points,
                            const Superquadric& start,
                            const LmOptions& options);

} // namespace pcl_sq::detail
