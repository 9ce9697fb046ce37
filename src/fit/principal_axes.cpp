// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_superquadric.h"

#include "util/point_set.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>

namespace pcl_sq {

namespace {

Eigen::Matrix3d axesOf(const detail::Moments& moments) {
  if (moments.count < 2)
    return Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments.covariance);
  const Eigen::Matrix3d& axes = eigen.eigenvectors();
  // the assignment of axes to x, y, z with the largest sum of |cosines| (E11)
  std::array<int, 3> order{0, 1, 2}, best = order;
  double best_sum = -1.0;
  do {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += std::abs(axes(k, order[k]));
    if (sum > best_sum) {
      best_sum = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  Eigen::Matrix3d rotation;
  for (int k = 0; k < 3; ++k)
    rotation.col(k) = axes.col(best[k]) * (axes(k, best[k]) < 0.0 ? -1.0 : 1.0);
  if (rotation.determinant() < 0.0) { // turn the axis whose sign means least
    Eigen::Index least;
    rotation.diagonal().cwiseAbs().minCoeff(&least);
    rotation.col(least) *= -1.0;
  }
  return rotation;
}

} // namespace

Eigen::Matrix3d principalAxes(const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  return axesOf(detail::momentsOf(points));
}

Eigen::Matrix3d principalAxes(const CloudPoints& points) {
  return axesOf(detail::momentsOf(points));
}

} // namespace pcl_sq
