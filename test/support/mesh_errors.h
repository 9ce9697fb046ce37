// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/triangle_shape.h"
#include "mesh/union_mesh.h"
#include "mesh_laws.h"
#include "random_superquadric.h"

#include <algorithm>

namespace pcl_sq::test {

/** \brief A point on a mesh, and the triangle that it is on. */
struct MeshPoint {
  Eigen::Vector3d place;
  std::size_t triangle;
};

/** \brief Random points on a mesh, uniform in area. */
inline std::vector<MeshPoint>
pointsOn(const TriangleMesh& mesh, int count, Random& random) {
  std::vector<double> areas;
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    areas.push_back(area += doubleArea(mesh, t).norm());
  std::vector<MeshPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto at =
        std::lower_bound(areas.begin(), areas.end(), area * random.uniform(0.0, 1.0));
    const std::size_t t =
        std::min(std::size_t(at - areas.begin()), mesh.triangles.size() - 1);
    double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const auto& c = mesh.triangles[t];
    const Eigen::Vector3d& a = mesh.vertices[c[0]];
    points.push_back(
        {a + u * (mesh.vertices[c[1]] - a) + v * (mesh.vertices[c[2]] - a), t});
  }
  return points;
}

/** \brief Distance of a point to the surface of a union, from above: to the nearest of
 * the feet on the parts and on the seams of two that are on the union's surface. */
inline double surfaceDistance(const MultiSuperquadric& model,
                              const Eigen::Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Eigen::Vector3d& foot) {
    if (model.gauge(foot) > 1.0 - 1e-7)
      nearest = std::min(nearest, (foot - point).norm());
  };
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < model.size(); ++k) {
    const Superquadric& part = model.parts[k];
    if ((point - part.center).norm() - part.halfSizes().norm() > nearest)
      continue; // farther for certain
    const Eigen::Vector3d foot = part.closestPoint(point);
    order.emplace_back((foot - point).norm(), k);
    offer(foot);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first < nearest; ++j) {
      Eigen::Vector3d seam = point;
      if (detail::ontoParts(model, {order[i].second, order[j].second}, seam))
        offer(seam);
    }
  return nearest;
}

/** \brief Distance of a point to the nearest triangle. */
inline double meshDistance(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const std::array<Eigen::Vector3d, 3> corners = {
        mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Eigen::Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Eigen::Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    if ((point - point.cwiseMax(low).cwiseMin(high)).norm() < nearest)
      nearest = std::min(nearest, detail::triangleDistance(point, corners));
  }
  return nearest;
}

/** \brief How a mesh errs from the surface of a union. */
struct MeshErrors {
  double outward = 0.0; ///< largest distance of the mesh's points to the surface [m]
  double inward = 0.0;  ///< largest distance of the surface's points to the mesh [m]
  double askew =
      0.0; ///< share of the area more than 20 degrees off the surface near it
};

/** \brief At \a count points of either, uniform in area. */
inline MeshErrors errorsOf(const MultiSuperquadric& model,
                           const TriangleMesh& mesh,
                           double reach,
                           int count) {
  Random random(7);
  MeshErrors errors;
  for (const MeshPoint& p : pointsOn(mesh, count, random)) {
    errors.outward = std::max(errors.outward, surfaceDistance(model, p.place));
    // of the normals within reach one must fit: ridges and seams have more than one
    const Eigen::Vector3d normal = doubleArea(mesh, p.triangle).normalized();
    bool fits = false;
    for (const Superquadric& part : model.parts)
      for (int i = 0; i < 27 && !fits; ++i) {
        const Eigen::Vector3d near =
            p.place + reach * Eigen::Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        fits = std::abs(part.firstOrderDistance(near)) < 2.0 * reach &&
               normal.dot(part.normal(near)) > 0.94;
      }
    errors.askew += fits ? 0.0 : 1.0 / count;
  }
  std::vector<double> areas;
  double area = 0.0;
  std::vector<TriangleMesh> parts;
  for (const Superquadric& part : model.parts) {
    parts.push_back(meshSuperquadric(part, 24));
    for (std::size_t t = 0; t < parts.back().triangles.size(); ++t)
      area += doubleArea(parts.back(), t).norm();
    areas.push_back(area);
  }
  for (int i = 0; i < count; ++i) {
    const std::size_t k = std::size_t(
        std::lower_bound(
            areas.begin(), areas.end() - 1, area * random.uniform(0.0, 1.0)) -
        areas.begin());
    const Superquadric& part = model.parts[k];
    Eigen::Vector3d p = pointsOn(parts[k], 1, random)[0].place;
    p = part.radialProjection(p);
    if (model.gauge(p) > 1.0 - 1e-9)
      errors.inward = std::max(errors.inward, meshDistance(mesh, p));
  }
  return errors;
}

/** \brief Volume by the divergence theorem; positive if triangles face outward. */
inline double enclosedVolume(const TriangleMesh& mesh) {
  double six = 0.0;
  const Eigen::Vector3d o = mesh.vertices.front();
  for (const auto& t : mesh.triangles)
    six += (mesh.vertices[t[0]] - o)
               .dot((mesh.vertices[t[1]] - o).cross(mesh.vertices[t[2]] - o));
  return six / 6.0;
}

} // namespace pcl_sq::test
