// SPDX-License-Identifier: BSD-3-Clause
// The sums of a PlaneCost as it is defined, plane by plane: an oracle for the kernels.
#pragma once

#include "view_fit/plane_cost.h"

#include <cmath>

namespace pcl_sq::detail {

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
