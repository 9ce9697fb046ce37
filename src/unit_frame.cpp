// SPDX-License-Identifier: BSD-3-Clause
#include "unit_frame.h"

namespace pcl_sq::detail {

namespace {

std::size_t padded(std::size_t count) {
  return (count + kernels::BLOCK - 1) / kernels::BLOCK * kernels::BLOCK;
}

} // namespace

void UnitPoints::reserve(std::size_t count) {
  for (std::vector<float>* v : {&x_, &y_, &z_})
    v->resize(padded(count), 0.0F);
}

void UnitPoints::setPrecision(const std::vector<float>& precision) {
  precision_ = precision;
  if (!precision_.empty())
    precision_.resize(padded(count_), 0.0F);
}

kernels::Shape toShape(const Superquadric& s) {
  kernels::Shape shape;
  const Eigen::Vector3d offset = s.rotation.transpose() * s.center;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      shape.axes[i][k] = static_cast<float>(s.rotation(k, i));
    shape.offset[i] = static_cast<float>(offset[i]);
    shape.inverse_axis[i] = static_cast<float>(1.0 / s.semi_axes[i]);
  }
  shape.epsilon1 = static_cast<float>(s.epsilon1);
  shape.epsilon2 = static_cast<float>(s.epsilon2);
  return shape;
}

} // namespace pcl_sq::detail
