// SPDX-License-Identifier: BSD-3-Clause
// Private. Least squares over the parameters of a bent rod.
#pragma once

#include "view_problem/view_problem.h"

namespace pcl_sq::detail {

/** \brief M24: points and planes, as minimiseSquares() wants them, of a body with e2 =
 * 1 whose z axis is bent towards its x axis. Parameters: t along the own axes, w, ln a,
 * e1, the curvature. */
class BentProblem {
public:
  static constexpr int N = 11;
  using Model = Superquadric;
  using Equations = SquareSums<N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /** \param[in] points of the problem or fewer; kept by reference
   * \param[in] sigma of the points \param[in] few whether some of the outline's planes
   * will do */
  BentProblem(const ViewProblem& problem,
              const UnitPoints& points,
              double sigma,
              bool few = false);

  Equations evaluate(const Superquadric& model) const;
  Superquadric moved(const Superquadric& m, const Vector& step, bool& limited) const;
  bool isActiveBound(const Superquadric& m, const Vector& direction) const;
  double rounding() const { return 1e-14 * double(points_.size()); }
  double unit() const { return planes_.unit; }

private:
  /** \brief Largest exponent of the ends. */
  double maxEpsilon() const;

  const UnitPoints& points_;
  LmOptions limits_;
  PlaneCost planes_;
};

/** \brief Free directions. \param[in] round a1 = a2 \param[in] held the y axis, around
 * which the rod is bent, is held parallel to the table's normal: it lies there */
Basis<BentProblem::N> bentBasis(bool round, bool held);

/** \brief Arcs of circles along the points, in the planes in which they may lie. */
std::vector<Superquadric> bentStarts(const ViewProblem& problem);

} // namespace pcl_sq::detail
