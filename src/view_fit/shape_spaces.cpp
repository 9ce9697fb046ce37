// SPDX-License-Identifier: BSD-3-Clause
#include "view_fit/shape_spaces.h"

namespace pcl_sq::detail {

Superquadric withAxis(const Superquadric& m, int k) {
  Superquadric s = m;
  for (int i = 0; i < 3; ++i) {
    s.rotation.col(i) = m.rotation.col((i + k + 1) % 3);
    s.semi_axes[i] = m.semi_axes[(i + k + 1) % 3];
  }
  if (k != 2)
    std::swap(s.epsilon1, s.epsilon2);
  return s;
}

Superquadric dual(const Superquadric& m) {
  Superquadric s = m;
  const double e = std::min(m.epsilon2, 2.0 - m.epsilon2);
  const double grown = std::sqrt(2.0) + (1.0 - std::sqrt(2.0)) * e;
  const double factor = m.epsilon2 <= 1.0 ? grown : 1.0 / grown;
  s.semi_axes[0] = s.semi_axes[1] = factor * std::sqrt(m.semi_axes[0] * m.semi_axes[1]);
  s.epsilon2 = std::max(2.0 - m.epsilon2, 0.1);
  s.rotation *=
      Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return s;
}

Superquadric upright(const Superquadric& m, int k, const Eigen::Vector3d& up) {
  Superquadric s = m;
  const Eigen::Vector3d axis = m.rotation.col(k);
  const Eigen::Vector3d target = axis.dot(up) < 0.0 ? Eigen::Vector3d(-up) : up;
  s.rotation =
      Eigen::Quaterniond::FromTwoVectors(axis, target).toRotationMatrix() * m.rotation;
  return s;
}

ParameterSpace standing(const ParameterSpace& space, int k) {
  ParameterSpace reduced = space;
  int columns = 0;
  for (int c = 0; c < space.basis.cols(); ++c) {
    const auto turn = space.basis.col(c).segment<3>(3);
    if (turn.norm() == 0.0 || turn[k] != 0.0)
      reduced.basis.col(columns++) = space.basis.col(c);
  }
  reduced.basis.conservativeResize(11, columns);
  return reduced;
}

ParameterSpace spaceOf(ShapeClass shape) {
  switch (shape) {
  case ShapeClass::ROTATIONAL:
    return ParameterSpace::rotational();
  case ShapeClass::BOX:
  case ShapeClass::ELLIPSOID:
    return ParameterSpace::without(1U << 9 | 1U << 10);
  case ShapeClass::GENERIC:
  case ShapeClass::TAPERED:
  case ShapeClass::VESSEL:
    break;
  }
  return {};
}

} // namespace pcl_sq::detail
