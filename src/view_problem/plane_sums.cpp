// SPDX-License-Identifier: BSD-3-Clause
#include "view_problem/plane_sums.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr float TOUCHED = -1e30F; ///< what a tangent plane's residual always exceeds

} // namespace

PlaneSums::PlaneSums(const PlaneCost& c)
    : view_(c.view), half_width_(c.half_width), unit_(c.unit) {
  const std::size_t planes = c.silhouette.size() + c.tangents.size() + c.limits.size();
  ends_ = (planes + kernels::BLOCK - 1) / kernels::BLOCK * kernels::BLOCK;
  for (std::vector<float>& array : arrays_)
    array.resize(ends_ + kernels::BLOCK);
  const bool dilated = c.dilation_sigma > 0.0 && !c.silhouette.empty();
  for (const TangentPlane& plane : c.silhouette) {
    set(count_++, plane, TOUCHED, dilated ? 1.0 / plane.sigma : 0.0);
    precision_ += 1.0 / (plane.sigma * plane.sigma);
  }
  precision_ = dilated ? precision_ + 1.0 / (c.dilation_sigma * c.dilation_sigma) : 0.0;
  for (const TangentPlane& plane : c.tangents)
    set(count_++, plane, TOUCHED, 0.0);
  for (const TangentPlane& plane : c.limits)
    set(count_++, plane, 0.0F, 0.0);
  for (const double side : {-1.0, 1.0}) {
    TangentPlane end;
    end.normal = side * view_;
    end.sigma = unit_; // of weight one
    set(ends_ + (side > 0.0), end, TOUCHED, 0.0);
  }
}

void PlaneSums::set(std::size_t i,
                    const TangentPlane& plane,
                    float least,
                    double shared) {
  const double values[ARRAYS] = {plane.normal.x(),
                                 plane.normal.y(),
                                 plane.normal.z(),
                                 plane.offset,
                                 unit_ / plane.sigma,
                                 double(least),
                                 shared};
  for (int k = 0; k < ARRAYS; ++k)
    arrays_[k][i] = static_cast<float>(values[k]);
}

kernels::Planes PlaneSums::planes(std::size_t begin, std::size_t count) const {
  return {arrays_[X].data() + begin,
          arrays_[Y].data() + begin,
          arrays_[Z].data() + begin,
          arrays_[OFFSET].data() + begin,
          arrays_[WEIGHT].data() + begin,
          arrays_[LEAST].data() + begin,
          arrays_[SHARED].data() + begin,
          count};
}

template <int N, int R>
void PlaneSums::addPlanes(const kernels::PlaneSumsOf<R>& sums, SquareSums<N>& e) const {
  const double share = precision_ > 0.0 ? 1.0 / precision_ : 0.0;
  const auto product = [&](int i, int j) {
    return sums.products[i][j] - share * sums.shared[i] * sums.shared[j];
  };
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < i; ++j)
      e.jtj(i, j) += product(j, i);
    for (int j = i; j < N; ++j)
      e.jtj(i, j) += product(i, j);
    e.jtr[i] += product(i, N);
  }
  e.cost += product(N, N);
}

template <int N>
void PlaneSums::addDepthPrior(const Eigen::Matrix<double, N, 1>& derivatives,
                              double half_depth,
                              SquareSums<N>& e) const {
  if (half_depth > half_width_)
    e.addRow(unit_ / (DEPTH_SIGMA * half_depth) * derivatives,
             unit_ / DEPTH_SIGMA * std::log(half_depth / half_width_));
}

void PlaneSums::operator()(const Superquadric& body, SquareSums<11>& e) const {
  if (count_ > 0) {
    kernels::PlaneSums sums;
    kernels::kernels().planes(planes(0, count_), toShape(body), sums);
    addPlanes(sums, e);
  }
  if (!(half_width_ > 0.0))
    return;
  double half_depth;
  Vector11 derivatives = body.supportJacobian(view_, half_depth);
  derivatives.head<3>().setZero(); // the depth stays as the body moves
  addDepthPrior(derivatives, half_depth, e);
}

void PlaneSums::operator()(const Superquadric& body, SquareSums<13>& e) const {
  if (count_ > 0) {
    kernels::PlaneSumsOf<kernels::TAPERED_ROWS> sums;
    kernels::kernels().taperedPlanes(planes(0, count_), toShape(body), sums);
    addPlanes(sums, e);
  }
  if (!(half_width_ > 0.0))
    return;
  alignas(64) float rows[kernels::TAPERED_ROWS][kernels::BLOCK];
  kernels::kernels().taperedRows(planes(ends_, 2), toShape(body), rows);
  Vector13 derivatives;
  for (int i = 0; i < 13; ++i)
    derivatives[i] = 0.5 * (double(rows[i][0]) + double(rows[i][1]));
  addDepthPrior(derivatives, 0.5 * (double(rows[13][0]) + double(rows[13][1])), e);
}

} // namespace pcl_sq::detail
