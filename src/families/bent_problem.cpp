// SPDX-License-Identifier: BSD-3-Clause
#include "families/bent_problem.h"

#include "families/robust_cost.h"
#include "geometry/bend.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr double MAX_EPSILON = 1.5; ///< the ends of a rod are not pinched
constexpr double TRUST = 0.5;       ///< largest steps
constexpr double SLIGHTEST = 1e-6;  ///< curvature; a bend of zero is none

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
  Equations e;
  const RobustCost density{limits_.sigma > 0.0 ? limits_.sigma : 1.0, limits_.outlier};
  const float* precision = points_.view().precision;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Place foot;
    const BodyRow body = footPointRow(s, points_[i].cast<double>(), &foot);
    // the surface moves on along its normal
    const Eigen::Vector3d gradient = logGradient(s, foot);
    const Vector row = rowOf(body.derivatives,
                             -gradient.dot(bendVelocity(s, foot.unbent)) /
                                 std::max(gradient.norm(), 1e-300));
    const double q = precision ? double(precision[i]) : 1.0;
    const double square = q * body.value * body.value;
    double share;
    e.cost += density.cost(square, share);
    e.share += share;
    e.weighted += share * square;
    e.jtj.selfadjointView<Eigen::Lower>().rankUpdate(row, share * q);
    e.jtr += share * q * body.value * row;
  }
  e.jtj.triangularView<Eigen::StrictlyUpper>() = e.jtj.transpose();
  e.points_cost = e.cost;
  const auto row = [&](const Eigen::Vector3d& normal) {
    Eigen::Vector3d touching;
    const BodyRow body = supportRow(s, normal, &touching);
    const Eigen::Vector3d n = s.rotation.transpose() * normal;
    return PlaneRow<N>{body.value,
                       rowOf(body.derivatives, n.dot(bendVelocity(s, touching)))};
  };
  const auto reach = [&](const Eigen::Vector3d& normal) {
    return normal.dot(s.center) + s.support(normal);
  };
  addPlaneCost<N>(planes_, row, reach, e);
  return e;
}

Superquadric
BentProblem::moved(const Superquadric& m, const Vector& step, bool& limited) const {
  Vector s = step;
  limited = false;
  const auto shorten = [&](int begin, int size, double trust) {
    double largest = 0.0;
    for (int k = begin; k < begin + size; ++k)
      largest = std::max(largest, std::abs(s[k]));
    if (!(largest > trust))
      return;
    for (int k = begin; k < begin + size; ++k)
      s[k] *= trust / largest;
    limited = true;
  };
  shorten(0, 3, TRUST * m.semi_axes.maxCoeff());
  shorten(3, 3, TRUST);
  shorten(6, 3, TRUST);
  shorten(9, 1, TRUST);
  shorten(10, 1, TRUST / m.semi_axes.z());
  Superquadric next = m;
  next.center += m.rotation * s.head<3>();
  const Eigen::Vector3d turn = s.segment<3>(3);
  if (turn.norm() > 0.0)
    next.rotation *=
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  for (int k = 0; k < 3; ++k)
    next.semi_axes[k] = std::clamp(
        m.semi_axes[k] * std::exp(s[6 + k]), limits_.min_axis, limits_.max_axis);
  next.epsilon1 = std::clamp(m.epsilon1 + s[9], limits_.min_epsilon, MAX_EPSILON);
  const double most = mostBent(next);
  next.bend = std::clamp(m.bend + s[10], -most, most);
  if (std::abs(next.bend) < SLIGHTEST)
    next.bend = std::copysign(SLIGHTEST, next.bend);
  return next;
}

bool BentProblem::isActiveBound(const Superquadric& m, const Vector& direction) const {
  const auto out = [](double value, double low, double high, double d) {
    return (value <= low && d < 0.0) || (value >= high && d > 0.0);
  };
  for (int k = 0; k < 3; ++k)
    if (out(m.semi_axes[k], limits_.min_axis, limits_.max_axis, direction[6 + k]))
      return true;
  const double most = mostBent(m);
  return out(m.epsilon1, limits_.min_epsilon, MAX_EPSILON, direction[9]) ||
         out(m.bend, -most, most, direction[10]);
}

Basis<BentProblem::N> bentBasis(bool round, bool held) {
  constexpr int N = BentProblem::N;
  Basis<N> basis = Basis<N>::Zero(N, N);
  int columns = 0;
  for (int k = 0; k < N; ++k) {
    if ((held && (k == 3 || k == 5)) || (round && k == 7))
      continue;
    basis(k, columns) = 1.0;
    if (round && k == 6)
      basis(7, columns) = 1.0;
    ++columns;
  }
  return basis.leftCols(columns);
}

} // namespace pcl_sq::detail
