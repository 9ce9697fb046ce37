// SPDX-License-Identifier: BSD-3-Clause
#include "view_fit/plane_sums.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr float TOUCHED = -1e30F; ///< what a tangent plane's residual always exceeds

} // namespace

PlaneSums::PlaneSums(const PlaneCost& c)
    : view_(c.view), half_width_(c.half_width), unit_(c.unit) {
  const std::size_t planes = c.silhouette.size() + c.tangents.size() + c.limits.size();
  for (std::vector<float>& array : arrays_)
    array.resize((planes + kernels::BLOCK - 1) / kernels::BLOCK * kernels::BLOCK);
  const bool dilated = c.dilation_sigma > 0.0 && !c.silhouette.empty();
  for (const TangentPlane& plane : c.silhouette) {
    add(plane, c.unit, TOUCHED, dilated ? 1.0 / plane.sigma : 0.0);
    precision_ += 1.0 / (plane.sigma * plane.sigma);
  }
  precision_ = dilated ? precision_ + 1.0 / (c.dilation_sigma * c.dilation_sigma) : 0.0;
  for (const TangentPlane& plane : c.tangents)
    add(plane, c.unit, TOUCHED, 0.0);
  for (const TangentPlane& plane : c.limits)
    add(plane, c.unit, 0.0F, 0.0);
}

void PlaneSums::add(const TangentPlane& plane,
                    double unit,
                    float least,
                    double shared) {
  const double values[ARRAYS] = {plane.normal.x(),
                                 plane.normal.y(),
                                 plane.normal.z(),
                                 plane.offset,
                                 unit / plane.sigma,
                                 double(least),
                                 shared};
  for (int k = 0; k < ARRAYS; ++k)
    arrays_[k][count_] = static_cast<float>(values[k]);
  ++count_;
}

kernels::Planes PlaneSums::view() const {
  return {arrays_[X].data(),
          arrays_[Y].data(),
          arrays_[Z].data(),
          arrays_[OFFSET].data(),
          arrays_[WEIGHT].data(),
          arrays_[LEAST].data(),
          arrays_[SHARED].data(),
          count_};
}

void PlaneSums::operator()(const Superquadric& body, NormalEquations& e) const {
  if (count_ > 0) {
    kernels::PlaneSums sums;
    kernels::kernels().planes(view(), toShape(body), sums);
    const double share = precision_ > 0.0 ? 1.0 / precision_ : 0.0;
    const auto product = [&](int i, int j) {
      return sums.products[i][j] - share * sums.shared[i] * sums.shared[j];
    };
    for (int i = 0; i < 11; ++i) {
      for (int j = 0; j < i; ++j)
        e.jtj(i, j) += product(j, i);
      for (int j = i; j < 11; ++j)
        e.jtj(i, j) += product(i, j);
      e.jtr[i] += product(i, 11);
    }
    e.cost += product(11, 11);
  }
  if (!(half_width_ > 0.0))
    return;
  double half_depth;
  Vector11 derivatives = body.supportJacobian(view_, half_depth);
  if (half_depth <= half_width_)
    return;
  derivatives.head<3>().setZero(); // the depth stays as the body moves
  e.addRow(unit_ / (DEPTH_SIGMA * half_depth) * derivatives,
           unit_ / DEPTH_SIGMA * std::log(half_depth / half_width_));
}

} // namespace pcl_sq::detail
