// SPDX-License-Identifier: BSD-3-Clause
// Private. The cost of tangent planes and half-spaces beside that of the points, and
// its sums for any body with a support function.
#pragma once

#include "pcl_sq/tangent_plane.h"
#include "solver/levenberg_marquardt.h"
#include "tuning/view_tuning.h"

#include <cmath>
#include <vector>

namespace pcl_sq::detail {

using tuning::odds::BENT;
using tuning::odds::DEPTH_SIGMA;
using tuning::odds::SHARED_AXIS;
using tuning::odds::TAPER;
using tuning::odds::VESSEL;

/** \brief Squared, weighted support residuals, in the frame of the points.
 *
 * M7: the silhouette's lines share an unknown dilation b ~ N(0, dilation_sigma^2),
 * which is integrated out: sum z^2 - (sum z u)^2 / (sum u^2 + 1 / dilation_sigma^2),
 * with z the residuals over their sigmas and u the inverse sigmas; the Gauss-Newton
 * matrix loses the same term of rank one.
 *
 * M8: what the camera cannot see is unlikely to be much deeper than what it sees is
 * wide: ln(half depth / half width) ~ N(0, DEPTH_SIGMA^2) where it is positive. That is
 * next to nothing beside any evidence and decides where there is none: a rod, seen from
 * the side, may otherwise be the edge of a plate. */
struct PlaneCost {
  std::vector<TangentPlane> silhouette; ///< tangents with a common dilation
  std::vector<TangentPlane> tangents;   ///< planes that the body touches
  std::vector<TangentPlane> limits;     ///< half-spaces that hold the body
  double dilation_sigma = 0.0;          ///< 0: the silhouette is exact
  /** \brief Direction away from the camera, unit length. */
  Eigen::Vector3d view = Eigen::Vector3d::UnitZ();
  /** \brief Half the body's smaller width across the view; 0: no prior on its depth. */
  double half_width = 0.0;
  /** \brief What a residual of one sigma costs, as a length: makes the costs of planes
   * and points comparable. */
  double unit = 1.0;

  bool empty() const {
    return silhouette.empty() && tangents.empty() && limits.empty() &&
           half_width == 0.0;
  }
};

/** \brief A plane's residual normal . center + h(normal) - offset, and its derivatives.
 */
template <int N>
struct PlaneRow {
  double reach = 0.0; ///< normal . center + h(normal)
  Eigen::Matrix<double, N, 1> derivatives;
};

/** \brief Adds the cost and its Gauss-Newton model to sums with jtj, jtr and cost.
 * \param[in] row direction -> PlaneRow<N> \param[in] reach direction -> reach alone
 */
template <int N, typename Sums, typename Row, typename Reach>
void addPlaneCost(const PlaneCost& c, const Row& row, const Reach& reach, Sums& e) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const auto add = [&e](const Vector& derivatives, double residual) {
    e.jtj.noalias() += derivatives * derivatives.transpose();
    e.jtr += derivatives * residual;
    e.cost += residual * residual;
  };
  Vector slope = Vector::Zero(); // derivatives of sum z u
  double sum = 0.0, precision = 0.0;
  for (const TangentPlane& plane : c.silhouette) {
    const double weight = c.unit / plane.sigma;
    const PlaneRow<N> r = row(plane.normal);
    const Vector weighted = weight * r.derivatives;
    const double z = weight * (r.reach - plane.offset);
    add(weighted, z);
    sum += z / plane.sigma;
    precision += 1.0 / (plane.sigma * plane.sigma);
    slope += weighted / plane.sigma;
  }
  if (c.dilation_sigma > 0.0 && precision > 0.0) {
    precision += 1.0 / (c.dilation_sigma * c.dilation_sigma);
    e.jtj.noalias() -= slope * slope.transpose() / precision;
    e.jtr -= slope * (sum / precision);
    e.cost -= sum * sum / precision;
  }
  for (const TangentPlane& plane : c.tangents) {
    const double weight = c.unit / plane.sigma;
    const PlaneRow<N> r = row(plane.normal);
    add(weight * r.derivatives, weight * (r.reach - plane.offset));
  }
  for (const TangentPlane& plane : c.limits)
    if (reach(plane.normal) > plane.offset) {
      const double weight = c.unit / plane.sigma;
      const PlaneRow<N> r = row(plane.normal);
      add(weight * r.derivatives, weight * (r.reach - plane.offset));
    }
  if (!(c.half_width > 0.0))
    return;
  const double half_depth = 0.5 * (reach(c.view) + reach(-c.view));
  if (half_depth > c.half_width) {
    const Vector both = row(c.view).derivatives + row(-c.view).derivatives;
    add(c.unit / (DEPTH_SIGMA * half_depth) * 0.5 * both,
        c.unit / DEPTH_SIGMA * std::log(half_depth / c.half_width));
  }
}

} // namespace pcl_sq::detail
