// SPDX-License-Identifier: BSD-3-Clause
#include "solver/surface_area.h"

#include "geometry/gauge.h"

#include <array>
#include <memory>

namespace pcl_sq::detail {

namespace {

constexpr int NODES = 8;  ///< per edge of a cube's face, where the table is made
constexpr int MERGED = 2; ///< per edge, in the table
constexpr int COUNT = 3 * MERGED * MERGED;
constexpr int GRID = 14; ///< intervals of each exponent
constexpr double STEP = (Superquadric::MAX_EPSILON - Superquadric::MIN_EPSILON) / GRID;

using AreaVectors = Eigen::Matrix<double, 3, COUNT>;

/** \brief Area vectors of an octant of the superquadric with unit semi-axes: midpoint
 * rule over three faces of the cube, projected radially; neighbours merged and scaled
 * to the sum of their areas. */
AreaVectors unitAreaVectors(double epsilon1, double epsilon2) {
  AreaVectors vectors = AreaVectors::Zero();
  Eigen::Matrix<double, COUNT, 1> areas = Eigen::Matrix<double, COUNT, 1>::Zero();
  for (int face = 0; face < 3; ++face)
    for (int i = 0; i < NODES; ++i)
      for (int j = 0; j < NODES; ++j) {
        Eigen::Vector3d d;
        d[face] = 1.0;
        d[(face + 1) % 3] = (i + 0.5) / NODES;
        d[(face + 2) % 3] = (j + 0.5) / NODES;
        // the cone over a patch of the cube's face, cut off at gauge one, has the area
        // vector rho^3 grad G(d) with rho = 1/G(d) and grad G = G grad ln G
        const LogGauge g = logGauge(d, Eigen::Vector3d::Ones(), epsilon1, epsilon2);
        const Eigen::Vector3d v =
            logGaugeGradient(g, d) * std::exp(-2.0 * g.value) / (NODES * NODES);
        const int k =
            (face * MERGED + i * MERGED / NODES) * MERGED + j * MERGED / NODES;
        vectors.col(k) += v;
        areas[k] += v.norm();
      }
  for (int k = 0; k < COUNT; ++k)
    if (areas[k] > 0.0)
      vectors.col(k) *= areas[k] / vectors.col(k).norm();
  return vectors;
}

struct Table {
  std::array<std::array<AreaVectors, GRID + 1>, GRID + 1> at; ///< [e1][e2]
  Table() {
    for (int i = 0; i <= GRID; ++i)
      for (int j = 0; j <= GRID; ++j)
        at[i][j] = unitAreaVectors(Superquadric::MIN_EPSILON + i * STEP,
                                   Superquadric::MIN_EPSILON + j * STEP);
  }
};

/** \brief Interval and position in it. */
int locate(double epsilon, double& fraction) {
  const double x =
      std::clamp((epsilon - Superquadric::MIN_EPSILON) / STEP, 0.0, double(GRID));
  const int i = std::min(static_cast<int>(x), GRID - 1);
  fraction = x - i;
  return i;
}

} // namespace

LogArea logArea(const Eigen::Vector3d& a, double epsilon1, double epsilon2) {
  static const std::unique_ptr<const Table> table = std::make_unique<Table>();
  double f1, f2;
  const int i = locate(epsilon1, f1);
  const int j = locate(epsilon2, f2);
  const AreaVectors low = (1.0 - f2) * table->at[i][j] + f2 * table->at[i][j + 1];
  const AreaVectors high =
      (1.0 - f2) * table->at[i + 1][j] + f2 * table->at[i + 1][j + 1];
  const AreaVectors left = (1.0 - f1) * table->at[i][j] + f1 * table->at[i + 1][j];
  const AreaVectors right =
      (1.0 - f1) * table->at[i][j + 1] + f1 * table->at[i + 1][j + 1];
  const Eigen::Vector3d cofactors(a[1] * a[2], a[0] * a[2], a[0] * a[1]);
  const auto scaling = cofactors.asDiagonal();
  const AreaVectors vectors = scaling * ((1.0 - f1) * low + f1 * high);
  const Eigen::Matrix<double, 1, COUNT> areas = vectors.colwise().norm();
  const double sum = areas.sum();
  // d area = sum of v . dv / |v|
  const AreaVectors units =
      vectors * areas.cwiseMax(1e-300).cwiseInverse().asDiagonal();
  const Eigen::Vector3d shares = units.cwiseProduct(vectors).rowwise().sum() / sum;
  LogArea result;
  result.value = std::log(8.0 * sum);
  // each cofactor leaves out one semi-axis
  result.gradient.head<3>() = Eigen::Vector3d::Ones() - shares;
  result.gradient[3] = units.cwiseProduct(scaling * (high - low)).sum() / (sum * STEP);
  result.gradient[4] =
      units.cwiseProduct(scaling * (right - left)).sum() / (sum * STEP);
  return result;
}

} // namespace pcl_sq::detail
