// SPDX-License-Identifier: BSD-3-Clause
// Private. The turn that takes one direction to another.
#pragma once

#include <Eigen/Geometry>

namespace pcl_sq::detail {

/** \brief The turn by the smallest angle that takes one direction to another: the
 * half turns about the first and about what halves the angle, one after the other. Of
 * opposite directions, one of the half turns that do. Eigen's FromTwoVectors() gives
 * the same by a singular value decomposition, which costs every file that names it a
 * third of its compilation. \param[in] from, to of any length but zero */
inline Eigen::Matrix3d shortestTurn(const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to) {
  const auto halfTurn = [](const Eigen::Vector3d& axis) -> Eigen::Matrix3d {
    return 2.0 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
  };
  constexpr double OPPOSITE = 1e-12; // of the sum's length: rounding is 1e-16
  const Eigen::Vector3d first = from.normalized(), second = to.normalized();
  const Eigen::Vector3d sum = first + second;
  Eigen::Vector3d middle =
      sum.norm() < OPPOSITE ? first.unitOrthogonal() : sum.normalized();
  if (sum.norm() <
      1.0) { // a short sum is hardly more than rounding: across the difference
    const Eigen::Vector3d across = (second - first).normalized();
    middle = (middle - across.dot(middle) * across).normalized();
  }
  return halfTurn(middle) * halfTurn(first);
}

} // namespace pcl_sq::detail
