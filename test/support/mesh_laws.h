// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pcl_sq::test {

/** \brief Whether every edge is run through once each way: closed, oriented, manifold.
 */
inline bool isWatertight(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      ++edges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : edges)
    if (count != 1 || edges.count({edge.second, edge.first}) == 0)
      return false;
  return !edges.empty();
}

/** \brief Normal of a triangle, as long as twice its area. */
inline Eigen::Vector3d doubleArea(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

/** \brief Distance of a point to a mesh: of each triangle to the foot of the
 * perpendicular where that is in it, else to its sides. */
inline double distanceTo(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d corners[] = {
        mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    bool above = true;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d &a = corners[k], side = corners[(k + 1) % 3] - a;
      above = above && normal.dot(side.cross(p - a)) >= 0.0;
      const double along = std::clamp(
          (p - a).dot(side) / std::max(side.squaredNorm(), 1e-300), 0.0, 1.0);
      nearest = std::min(nearest, (a + along * side - p).norm());
    }
    if (above)
      nearest = std::min(nearest, std::abs(normal.dot(p - corners[0])));
  }
  return nearest;
}

} // namespace pcl_sq::test
