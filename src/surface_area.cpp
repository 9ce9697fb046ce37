// SPDX-License-Identifier: BSD-3-Clause
#include "surface_area.h"

#include "gauge.h"

#include <array>

namespace pcl_sq::detail {

namespace {

constexpr int NODES = 4; ///< per edge of a cube's face
constexpr int COUNT = 3 * NODES * NODES;

using AreaVectors = std::array<Eigen::Vector3d, COUNT>;

/** \brief Area vectors of the octant of the superquadric with unit semi-axes: midpoint
 * rule over the three faces of the cube, each face projected radially. */
AreaVectors unitAreaVectors(double epsilon1, double epsilon2) {
  AreaVectors vectors;
  const Eigen::Vector3d ones = Eigen::Vector3d::Ones();
  int k = 0;
  for (int face = 0; face < 3; ++face)
    for (int i = 0; i < NODES; ++i)
      for (int j = 0; j < NODES; ++j) {
        Eigen::Vector3d d;
        d[face] = 1.0;
        d[(face + 1) % 3] = (i + 0.5) / NODES;
        d[(face + 2) % 3] = (j + 0.5) / NODES;
        // the cone over dA on the cube's face, cut at gauge one: its area vector is
        // rho^3 grad G(d) with rho = 1/G(d) and grad G = G grad ln G
        const LogGauge g = logGauge(d, ones, epsilon1, epsilon2);
        vectors[k++] =
            logGaugeGradient(g, d) * std::exp(-2.0 * g.value) / (NODES * NODES);
      }
  return vectors;
}

double area(const AreaVectors& vectors, const Eigen::Vector3d& cofactors) {
  double sum = 0.0;
  for (const Eigen::Vector3d& v : vectors)
    sum += v.cwiseProduct(cofactors).norm();
  return 8.0 * sum;
}

} // namespace

LogArea logArea(const Eigen::Vector3d& a, double epsilon1, double epsilon2) {
  constexpr double STEP = 1e-3;
  const Eigen::Vector3d cofactors(a[1] * a[2], a[0] * a[2], a[0] * a[1]);
  const AreaVectors vectors = unitAreaVectors(epsilon1, epsilon2);
  double sum = 0.0;
  Eigen::Vector3d shares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : vectors) {
    const Eigen::Vector3d s = v.cwiseProduct(cofactors);
    const double size = s.norm();
    sum += size;
    if (size > 0.0)
      shares += s.cwiseAbs2() / size;
  }
  LogArea result;
  result.value = std::log(8.0 * sum);
  // each cofactor leaves out one semi-axis
  result.gradient.head<3>() =
      Eigen::Vector3d::Constant(shares.sum() / sum) - shares / sum;
  result.gradient[3] =
      (std::log(area(unitAreaVectors(epsilon1 + STEP, epsilon2), cofactors)) -
       result.value) /
      STEP;
  result.gradient[4] =
      (std::log(area(unitAreaVectors(epsilon1, epsilon2 + STEP), cofactors)) -
       result.value) /
      STEP;
  return result;
}

} // namespace pcl_sq::detail
