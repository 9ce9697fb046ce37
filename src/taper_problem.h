// SPDX-License-Identifier: BSD-3-Clause
// Private. Tapered superquadrics fitted to points, with the mixture of the full fit. In
// double precision and point by point: a taper is asked for seldom, and the untapered
// fit's loops stay as short as they are.
#pragma once

#include "full_fit.h"
#include "taper_step.h"

namespace pcl_sq::detail {

/** \brief A tapered superquadric in the frame of the points, with its mixture. */
struct TaperCandidate {
  TaperedSuperquadric model;
  Mixture mixture;
  double nll = 0.0; ///< negative log-likelihood per point, see TaperProblem
};

/** \brief Points and what they are fitted with.
 *
 * One density on the surface, that of a given area, holds for all bodies: what they are
 * compared by is how close they come to the points and nothing else. With each body's
 * own area a single view would be won by the taper that makes the hidden side small. */
class TaperProblem {
public:
  TaperProblem(const UnitPoints& points, const FitSetting& setting, double area);

  std::size_t size() const { return points_.size(); }
  /** \brief Fits from a start, the mixture estimated anew after each round, until both
   * have settled. \param[in] free whether the taper is estimated too
   * \param[in] rounds at most \param[in] iterations in each \param[in] tolerance
   * relative decrease of the cost that ends a round */
  TaperCandidate anneal(TaperCandidate start,
                        bool free,
                        int rounds,
                        int iterations,
                        double tolerance) const;
  /** \brief Standard deviations of kx and ky at a minimum. */
  Eigen::Vector2d taperDeviations(const TaperCandidate& at) const;
  /** \brief Root mean square of the distances. */
  double rmsDistance(const TaperedSuperquadric& model) const;

private:
  struct Equations {
    Matrix13 jtj = Matrix13::Zero();
    Vector13 jtr = Vector13::Zero();
    NormalEquations sums; ///< cost and mixture; matrices of the size prior only
  };
  Equations evaluate(const TaperedSuperquadric& model, const Mixture& mixture) const;
  Equations minimise(TaperedSuperquadric& model,
                     const Mixture& mixture,
                     bool free,
                     int iterations,
                     double tolerance) const;

  std::vector<Eigen::Vector3d> points_;
  FitSetting setting_;
  double area_;
};

} // namespace pcl_sq::detail
