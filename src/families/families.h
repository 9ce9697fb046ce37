// SPDX-License-Identifier: BSD-3-Clause
// Private. The families that have parameters of their own beside a superquadric's.
#pragma once

#include "view_problem/view_problem.h"

#include <functional>

namespace pcl_sq::detail {

/** \brief Twice the logarithm of the prior odds against a family. */
inline double demandOf(ShapeClass shape) {
  return shape == ShapeClass::TAPERED  ? TAPER
         : shape == ShapeClass::BENT   ? BENT
         : shape == ShapeClass::VESSEL ? VESSEL
                                       : 0.0;
}

/** \brief The best tapered body, if the families' best ones show that a taper would
 * help: its share in what a Gauss-Newton step would gain (Rao's score test). */
std::optional<ShapeCandidate> fitTaper(const ViewProblem& problem,
                                       double sigma,
                                       const std::vector<ShapeCandidate>& candidates);

/** \brief Last iterations of a tapered body with other points of the problem. */
void fitTaperAgain(const ViewProblem& problem,
                   const UnitPoints& points,
                   double sigma,
                   ShapeCandidate& chosen);

/** \brief The upright solid of revolution with a lid below its rim, if that explains
 * the points better than all candidates. */
std::optional<ShapeCandidate> fitLid(const ViewProblem& problem,
                                     double sigma,
                                     const std::vector<ShapeCandidate>& candidates);

/** \brief The best bent rod, if no other family is near the points without filling what
 * the object leaves open.
 * \param[in] against what a body costs besides points and planes, in the unit frame: a
 * block may be near the points of a bend
 * \param[in] profile of a handle: the area that it covers in the view, over the frame's
 * unit squared. It is as wide as its area over its length, and no longer than its
 * points, for its ends are in the body; 0: no handle */
std::optional<ShapeCandidate>
fitBent(const ViewProblem& problem,
        double sigma,
        const std::vector<ShapeCandidate>& candidates,
        const std::function<double(const Superquadric&)>& against,
        double profile = 0.0);

/** \brief Last iterations of a bent rod with other points of the problem. */
void fitBentAgain(const ViewProblem& problem,
                  const UnitPoints& points,
                  double sigma,
                  ShapeCandidate& chosen);

/** \brief The best open vessel, if no solid is near the points or the best one hides
 * some of them. \param[in,out] candidates all solids; those pay for what they hide */
std::optional<ShapeCandidate> fitVessel(const ViewProblem& problem,
                                        double sigma,
                                        std::vector<ShapeCandidate>& candidates);

/** \brief Last iterations of a vessel with other points of the problem. */
void fitVesselAgain(const ViewProblem& problem,
                    const UnitPoints& points,
                    double sigma,
                    ShapeCandidate& chosen);

} // namespace pcl_sq::detail
