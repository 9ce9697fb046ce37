// SPDX-License-Identifier: BSD-3-Clause
#include "union/exposed_area.h"

#include "geometry/taper.h"
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/triangle_mesh.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int CELLS = 7; ///< per edge of an octant of the cube projected onto a part
constexpr int OCTANT = 3 * CELLS * CELLS;

/** \brief Of a body with a rim: the triangles of its mesh. */
SurfaceCells meshCells(const Superquadric& part) {
  const TriangleMesh mesh = meshSuperquadric(part, 2 * CELLS);
  const auto count = static_cast<Eigen::Index>(mesh.triangles.size());
  SurfaceCells cells;
  cells.middles.resize(3, count);
  cells.areas.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(i)];
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    cells.middles.col(i) = (a + b + c) / 3.0;
    cells.areas[i] = 0.5 * (b - a).cross(c - a).norm();
  }
  return cells;
}

} // namespace

SurfaceCells surfaceCells(const Superquadric& part) {
  if (part.isCut())
    return meshCells(part);
  SurfaceCells cells;
  constexpr Eigen::Index COUNT = Eigen::Index(8) * OCTANT;
  cells.middles.resize(3, COUNT);
  cells.areas.resize(COUNT);
  // Gauss's nodes are dense at the cube's edges, where small exponents bend the surface
  using Rule = boost::math::quadrature::gauss<double, CELLS>;
  std::array<double, CELLS> node, weight;
  for (int i = 0; i < CELLS; ++i) {
    const auto k = std::size_t(std::abs(i - CELLS / 2));
    node[std::size_t(i)] = 0.5 + (i < CELLS / 2 ? -0.5 : 0.5) * Rule::abscissa()[k];
    weight[std::size_t(i)] = 0.5 * Rule::weights()[k];
  }
  for (int c = 0; c < OCTANT; ++c) {
    const int face = c / (CELLS * CELLS);
    Eigen::Vector3d d;
    d[face] = 1.0;
    const auto u = std::size_t(c % CELLS), v = std::size_t(c / CELLS % CELLS);
    d[(face + 1) % 3] = node[u];
    d[(face + 2) % 3] = node[v];
    const double volume = part.semi_axes.prod() * weight[u] * weight[v];
    const Eigen::Vector3d local = d.cwiseProduct(part.semi_axes);
    const LogGauge g = logGauge(local, part.semi_axes, part.epsilon1, part.epsilon2);
    // the cone over a cell of the cube's face has three times the volume of its part
    // of the cube; cut off at gauge one, its area vector is volume * grad G / G^3
    const double shrink = std::exp(-g.value);
    const double area = volume * shrink * shrink * logGaugeGradient(g, local).norm();
    const Eigen::Vector3d normal = logGaugeGradient(g, local).normalized();
    for (int octant = 0; octant < 8; ++octant) {
      const Eigen::Vector3d sign(
          octant & 1 ? -1.0 : 1.0, octant & 2 ? -1.0 : 1.0, octant & 4 ? -1.0 : 1.0);
      const Eigen::Vector3d straight = shrink * local.cwiseProduct(sign);
      cells.middles.col(8 * c + octant) = part.toWorld(deformed(part, straight));
      cells.areas[8 * c + octant] =
          part.isDeformed()
              ? area *
                    deformedAreaVector(part, straight, normal.cwiseProduct(sign)).norm()
              : area;
    }
  }
  return cells;
}

void keepNearer(const Superquadric& body,
                const Eigen::Matrix3Xd& points,
                const Eigen::ArrayXd& reach,
                Eigen::VectorXd& distances) {
  const Eigen::Matrix3d turn = body.rotation.transpose();
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d local = turn * (points.col(i) - body.center);
    const Eigen::Vector3d outside = (local.cwiseAbs() - body.halfSizes()).cwiseMax(0.0);
    if (outside.squaredNorm() <= reach[i] * reach[i])
      near.push_back(i);
  }
  Eigen::Matrix3Xd nearby(3, static_cast<Eigen::Index>(near.size()));
  for (std::size_t k = 0; k < near.size(); ++k)
    nearby.col(static_cast<Eigen::Index>(k)) = points.col(near[k]);
  const Eigen::VectorXd found = surfaceDistances(body, nearby);
  for (std::size_t k = 0; k < near.size(); ++k)
    distances[near[k]] =
        std::min(distances[near[k]], found[static_cast<Eigen::Index>(k)]);
}

double exposedArea(const std::vector<Superquadric>& parts) {
  double sum = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const SurfaceCells cells = surfaceCells(parts[k]);
    // a cell that another part's surface crosses counts in part
    const Eigen::ArrayXd half = 0.5 * cells.areas.sqrt();
    Eigen::VectorXd beyond = half;
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (j != k)
        keepNearer(parts[j], cells.middles, half, beyond);
    const Eigen::ArrayXd visible = 0.5 + 0.5 * beyond.array() / half;
    sum += (visible.max(0.0) * cells.areas).sum();
  }
  return sum;
}

} // namespace pcl_sq::detail
