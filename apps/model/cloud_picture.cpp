// SPDX-License-Identifier: BSD-3-Clause
#ifdef PCL_SQ_HAVE_VISUALIZATION
#include "model/cloud_picture.h"

#include "pcl_sq/visualization/snapshot_renderer.h"

namespace pcl_sq::app {

void addCloud(SnapshotRenderer& renderer, const LoadedCloud& input) {
  const auto n = static_cast<Eigen::Index>(input.cloud->size());
  Eigen::Matrix3Xd points(3, n);
  SnapshotRenderer::Colors colors(3, input.has_color ? n : 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& p = (*input.cloud)[static_cast<std::size_t>(i)];
    points.col(i) = p.getVector3fMap().cast<double>();
    if (input.has_color)
      colors.col(i) << p.r, p.g, p.b;
  }
  renderer.addCloud(points, colors);
}

std::vector<TriangleMesh> meshesOf(const ModelFile& file) {
  std::vector<TriangleMesh> meshes;
  for (const Superquadric& part : file.model.parts)
    meshes.push_back(meshSuperquadric(part));
  return meshes;
}

} // namespace pcl_sq::app
#endif
