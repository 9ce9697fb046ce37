// SPDX-License-Identifier: BSD-3-Clause
#include "families/bent_problem.h"

#include "families/family_step.h"
#include "geometry/bend.h"
#include "tuning/view_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::family;
using namespace tuning::bent_problem;

/** \brief Largest curvature of a body that does not fold or meet itself. */
double mostBent(const Superquadric& s) {
  return 0.99 * std::min(Superquadric::MAX_BEND / s.semi_axes.z(),
                         Superquadric::MAX_FOLD / s.semi_axes.x());
}

/** \brief The first eleven of a body's derivatives with the curvature's in e2's place.
 */
BentProblem::Vector rowOf(const Vector13& derivatives, double by_curvature) {
  BentProblem::Vector row = derivatives.head<11>();
  row[10] = by_curvature;
  return row;
}

} // namespace

BentProblem::BentProblem(const ViewProblem& problem,
                         const UnitPoints& points,
                         double sigma,
                         bool few)
    : points_(points), limits_(problem.limits(sigma)),
      planes_(problem.planes(sigma, points, few)) {}

BentProblem::Equations BentProblem::evaluate(const Superquadric& s) const {
  kernels::Sums sums;
  kernels::kernels().bentEquations(
      points_.view(), toShape(s), float(s.bend), mixtureOf(limits_), sums);
  Equations e = squaresOf<N>(sums);
  const BentSupport slices(s);
  const auto row = [&](const Eigen::Vector3d& normal) {
    Eigen::Vector3d touching;
    const BodyRow body = supportRow(s, slices, normal, &touching);
    const Eigen::Vector3d n = s.rotation.transpose() * normal;
    return PlaneRow<N>{body.value,
                       rowOf(body.derivatives, n.dot(bendVelocity(s, touching)))};
  };
  const auto reach = [&](const Eigen::Vector3d& normal) {
    return normal.dot(s.center) + slices.contact(s.rotation.transpose() * normal).reach;
  };
  addPlaneCost<N>(planes_, row, reach, e);
  return e;
}

double BentProblem::maxEpsilon() const {
  return std::min(MAX_EPSILON, limits_.max_epsilon);
}

Superquadric
BentProblem::moved(const Superquadric& m, const Vector& step, bool& limited) const {
  Vector s = step;
  limited = shorten({{0, 3, TRUST * m.semi_axes.maxCoeff()},
                     {3, 3, TRUST},
                     {6, 3, TRUST},
                     {9, 1, TRUST},
                     {10, 1, TRUST / m.semi_axes.z()}},
                    s);
  Superquadric next = m;
  moveRigidly(s.head<3>(), s.segment<3>(3), next);
  for (int k = 0; k < 3; ++k)
    next.semi_axes[k] = std::clamp(
        m.semi_axes[k] * std::exp(s[6 + k]), limits_.min_axis, limits_.max_axis);
  next.epsilon1 = std::clamp(m.epsilon1 + s[9], limits_.min_epsilon, maxEpsilon());
  const double most = mostBent(next);
  next.bend = std::clamp(m.bend + s[10], -most, most);
  if (std::abs(next.bend) < SLIGHTEST)
    next.bend = std::copysign(SLIGHTEST, next.bend);
  return next;
}

bool BentProblem::isActiveBound(const Superquadric& m, const Vector& direction) const {
  for (int k = 0; k < 3; ++k)
    if (leaves(m.semi_axes[k], limits_.min_axis, limits_.max_axis, direction[6 + k]))
      return true;
  const double most = mostBent(m);
  return leaves(m.epsilon1, limits_.min_epsilon, maxEpsilon(), direction[9]) ||
         leaves(m.bend, -most, most, direction[10]);
}

Basis<BentProblem::N> bentBasis(bool round, bool held) {
  constexpr int N = BentProblem::N;
  Basis<N> basis = round && held ? basisWithout<N>({3, 5, 7})
                   : round       ? basisWithout<N>({7})
                   : held        ? basisWithout<N>({3, 5})
                                 : basisWithout<N>({});
  if (round) // a2 goes with a1
    basis.row(7) = basis.row(6);
  return basis;
}

} // namespace pcl_sq::detail
