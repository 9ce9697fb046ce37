// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/union_mesh.h"

#include <Eigen/LU>

namespace pcl_sq::detail {

namespace {

constexpr int MAX_STEPS = 30;
constexpr double CONVERGED = 1e-13;  ///< of a gauge
constexpr double LEAST_ANGLE = 1e-6; ///< squared sine between surfaces that cross

} // namespace

bool ontoParts(const MultiSuperquadric& model,
               const std::vector<std::size_t>& parts,
               Eigen::Vector3d& point) {
  // Newton's method with the shortest step; all gauges are convex
  const Eigen::Index count = Eigen::Index(parts.size());
  Eigen::Vector3d at = point;
  for (int step = 0; step < MAX_STEPS; ++step) {
    Eigen::VectorXd miss(count);
    Eigen::MatrixX3d slopes(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Superquadric& part = model.parts[parts[std::size_t(i)]];
      const Eigen::Vector3d slope = part.gaugeGradient(at);
      const double length = slope.norm();
      if (!(length > 0.0))
        return false;
      miss[i] = (1.0 - part.gauge(at)) / length;
      slopes.row(i) = slope.transpose() / length;
    }
    if (miss.cwiseAbs().maxCoeff() < CONVERGED * point.norm() + 1e-15) {
      point = at;
      return true;
    }
    const Eigen::MatrixXd angles = slopes * slopes.transpose();
    if (!(std::abs(angles.determinant()) > LEAST_ANGLE))
      return false;
    at += slopes.transpose() * angles.inverse() * miss;
    if (!at.allFinite())
      return false;
  }
  return false;
}

} // namespace pcl_sq::detail
