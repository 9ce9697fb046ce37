// SPDX-License-Identifier: BSD-3-Clause
#include "support_cost.h"

namespace pcl_sq::detail {

namespace {

constexpr double DEPTH_SIGMA = 0.4; ///< of the logarithm of depth over width

} // namespace

void SupportCost::operator()(const Superquadric& body, NormalEquations& e) const {
  Vector11 slope = Vector11::Zero(); // derivatives of sum z u
  double sum = 0.0, precision = 0.0;
  for (const SupportPlane& plane : silhouette) {
    const double weight = unit / plane.sigma;
    double residual;
    const Vector11 row = weight * plane.jacobian(body, residual);
    const double z = weight * residual;
    e.addRow(row, z);
    sum += z / plane.sigma;
    precision += 1.0 / (plane.sigma * plane.sigma);
    slope += row / plane.sigma;
  }
  if (dilation_sigma > 0.0 && precision > 0.0) {
    precision += 1.0 / (dilation_sigma * dilation_sigma);
    e.jtj.noalias() -= slope * slope.transpose() / precision;
    e.jtr -= slope * (sum / precision);
    e.cost -= sum * sum / precision;
  }
  for (const SupportPlane& plane : tangents) {
    const double weight = unit / plane.sigma;
    double residual;
    const Vector11 slope_of_plane = plane.jacobian(body, residual);
    e.addRow(weight * slope_of_plane, weight * residual);
  }
  for (const SupportPlane& plane : limits) {
    const double residual = plane.residual(body);
    const double weight = unit / plane.sigma;
    if (residual > 0.0)
      e.addRow(weight * plane.jacobian(body), weight * residual);
  }
  const double half_depth = body.support(view);
  if (half_width > 0.0 && half_depth > half_width) {
    Vector11 row = body.supportJacobian(view);
    row.head<3>().setZero(); // the depth, wherever the body is
    e.addRow(unit / (DEPTH_SIGMA * half_depth) * row,
             unit / DEPTH_SIGMA * std::log(half_depth / half_width));
  }
}

} // namespace pcl_sq::detail
