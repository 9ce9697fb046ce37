// SPDX-License-Identifier: BSD-3-Clause
#include "export/part_surface.h"

namespace pcl_sq::detail {

ShownSurface shownSurface(const Superquadric& part) {
  ShownSurface shown;
  shown.mesh = meshSuperquadric(part);
  shown.normals.assign(shown.mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& t : shown.mesh.triangles) {
    const Eigen::Vector3d& a = shown.mesh.vertices[t[0]];
    const Eigen::Vector3d normal =
        (shown.mesh.vertices[t[1]] - a).cross(shown.mesh.vertices[t[2]] - a);
    for (const std::uint32_t corner : t)
      shown.normals[corner] += normal; // weighted by area
  }
  for (Eigen::Vector3d& normal : shown.normals)
    normal = normal.norm() > 0.0 ? Eigen::Vector3d(normal.normalized())
                                 : Eigen::Vector3d::UnitZ();
  return shown;
}

Eigen::Quaterniond toYUp(const Eigen::Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitY());
}

} // namespace pcl_sq::detail
