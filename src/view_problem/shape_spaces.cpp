// SPDX-License-Identifier: BSD-3-Clause
#include "view_problem/shape_spaces.h"

#include "union/shortest_turn.h"

namespace pcl_sq::detail {

Superquadric upright(const Superquadric& m, int k, const Eigen::Vector3d& up) {
  Superquadric s = m;
  const Eigen::Vector3d axis = m.rotation.col(k);
  const Eigen::Vector3d target = axis.dot(up) < 0.0 ? Eigen::Vector3d(-up) : up;
  s.rotation = shortestTurn(axis, target) * m.rotation;
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
  case ShapeClass::BENT:
  case ShapeClass::VESSEL:
    break;
  }
  return {};
}

} // namespace pcl_sq::detail
