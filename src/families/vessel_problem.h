// SPDX-License-Identifier: BSD-3-Clause
// Private. Least squares over the parameters of an open vessel of revolution.
#pragma once

#include "families/family_step.h"
#include "families/vessel_profile.h"
#include "view_problem/view_problem.h"

#include <optional>

namespace pcl_sq::detail {

/** \brief M21: points, planes and the wall's prior, as minimiseSquares() wants them.
 *
 * Which wall a point lies on is told by its ray, not by what is near: the camera sees
 * the inside where the ray comes through the opening. Without a camera, or within a
 * pixel of the opening's edge, the nearest counts.
 *
 * Parameters: t (3, along the own axes), w (2, about x and y), ln a, ln a3, e1, k, rim,
 * ln wall. */
class VesselProblem {
public:
  static constexpr int N = 11;
  using Model = Superquadric;
  using Equations = SquareSums<N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  /** \param[in] points of the problem or fewer; kept by reference
   * \param[in] planes of the same number of points */
  VesselProblem(const ViewProblem& problem,
                const UnitPoints& points,
                double sigma,
                PlaneCost planes);

  Equations evaluate(const Superquadric& model) const;
  Superquadric moved(const Superquadric& m, const Vector& step, bool& limited) const;
  bool isActiveBound(const Superquadric& m, const Vector& direction) const;
  double rounding() const { return 1e-14 * double(points_.size()); }
  /** \brief Share of the points that lie nearer to the inside than to the outside. */
  double insideShare(const Superquadric& model) const;
  const PlaneCost& planes() const { return planes_; }
  double sigma() const { return limits_.sigma; }

private:
  Equations pointSums(const Superquadric& s, const VesselProfile& profile) const;
  void
  addPlanes(const Superquadric& s, const VesselProfile& profile, Equations& e) const;

  const UnitPoints& points_;
  LmOptions limits_;
  PlaneCost planes_, others_; ///< all, without the outline's
  std::optional<Eigen::Vector3d> eye_;
  double pixel_; ///< size of a pixel at the object
};

/** \brief Free directions: all, or without the axis's turns where it is upright. */
Basis<VesselProblem::N> vesselBasis(bool upright);

/** \brief Vessels around the points with a given axis, from the bottom up. */
std::vector<Superquadric> vesselStarts(const ViewProblem& p, const Eigen::Vector3d& up);

} // namespace pcl_sq::detail
