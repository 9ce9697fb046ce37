// SPDX-License-Identifier: BSD-3-Clause
#include "solver/descriptions.h"

#include <Eigen/Geometry>

namespace pcl_sq::detail {

Superquadric axesShifted(const Superquadric& body, int shift) {
  Superquadric s = body;
  for (int k = 0; k < 3; ++k) {
    s.rotation.col(k) = body.rotation.col((k + shift) % 3);
    s.semi_axes[k] = body.semi_axes[(k + shift) % 3];
  }
  return s;
}

Superquadric eighthTurn(Superquadric body) {
  body.rotation *=
      Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return body;
}

Superquadric withAxis(const Superquadric& body, int k) {
  Superquadric s = axesShifted(body, k + 1);
  if (k != 2)
    std::swap(s.epsilon1, s.epsilon2);
  return s;
}

Superquadric dual(const Superquadric& body) {
  Superquadric s = eighthTurn(body);
  const double e = std::min(body.epsilon2, 2.0 - body.epsilon2);
  const double grown = std::sqrt(2.0) + (1.0 - std::sqrt(2.0)) * e;
  const double factor = body.epsilon2 <= 1.0 ? grown : 1.0 / grown;
  s.semi_axes.head<2>().setConstant(factor *
                                    std::sqrt(body.semi_axes[0] * body.semi_axes[1]));
  s.epsilon2 = std::max(2.0 - body.epsilon2, Superquadric::MIN_EPSILON);
  return s;
}

} // namespace pcl_sq::detail
