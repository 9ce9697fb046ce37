// SPDX-License-Identifier: BSD-3-Clause
// Private. The steps of a fit to one view.
#pragma once

#include "view_problem/view_problem.h"

#include <functional>

namespace pcl_sq::detail {

/** \brief What else speaks against a body, in the cloud's frame, as a cost. */
using Objection = std::function<double(const Superquadric& body)>;

/** \brief fitView() without the points' distances in its summary: most fits are
 * only compared.
 * \param[in] objection that families are compared by as well, or none */
ViewFit searchView(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                   const ViewEvidence& evidence,
                   const ViewFitOptions& options,
                   const Objection& objection = {});

/** \brief The points' distances of a fit's model. */
void addDistances(const Eigen::Ref<const Eigen::Matrix3Xd>& points, FitSummary& fit);

/** \brief All families from the best general fit. */
std::vector<ShapeCandidate> fitShapes(const ViewProblem& problem, const Trial& general);

/** \brief Last iterations of the chosen family with other points of the problem. */
void fitAgain(const ViewProblem& problem,
              const UnitPoints& points,
              double sigma,
              ShapeCandidate& chosen);

/** \brief The family that a fit has chosen, from where it is, to points that are nearly
 * the same: the other families are not asked again. A sample of the points is enough.
 * \param[in] fit of a known noise, options.noise */
ViewFit fitSameFamily(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const ViewEvidence& evidence,
                      const ViewFitOptions& options,
                      ViewFit fit);

} // namespace pcl_sq::detail
