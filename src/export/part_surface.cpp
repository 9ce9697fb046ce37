// SPDX-License-Identifier: BSD-3-Clause
#include "export/part_surface.h"

#include "union/shortest_turn.h"

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

std::vector<PartLabel> labelsOf(const MultiSuperquadric& model) {
  std::vector<PartLabel> labels;
  for (std::size_t i = 0; i < model.size(); ++i)
    labels.push_back({"part " + std::to_string(i + 1), partColor(i)});
  return labels;
}

std::vector<PartLabel> labelsOf(const SceneFile& scene) {
  std::vector<PartLabel> labels;
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    const std::string thing = "thing " + std::to_string(k + 1);
    const std::size_t parts = scene.objects[k].file.model.size();
    for (std::size_t i = 0; i < parts; ++i)
      labels.push_back({parts == 1 ? thing : thing + ", part " + std::to_string(i + 1),
                        partColor(k)});
  }
  return labels;
}

ModelFile asOneModel(const SceneFile& scene) {
  ModelFile file;
  file.model = scene.all();
  file.table = scene.table;
  file.frame = scene.frame;
  file.input_path = scene.input_path;
  return file;
}

Eigen::Quaterniond toYUp(const Eigen::Vector3d& up) {
  return Eigen::Quaterniond(shortestTurn(up, Eigen::Vector3d::UnitY()));
}

} // namespace pcl_sq::detail
