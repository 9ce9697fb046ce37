// SPDX-License-Identifier: BSD-3-Clause
// For programs that have a pcl::visualization::PCLVisualizer: the only header of pcl_sq
// that needs PCL's visualization and VTK, and no other one includes it. Besides
// pcl_sq::visualization link PCL's own:
//
//   find_package(PCL REQUIRED COMPONENTS visualization)
//   target_link_libraries(mine PRIVATE pcl_sq::visualization pcl_visualization)
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/palette.h"

#include <pcl/conversions.h>
#include <pcl/point_types.h>
#include <pcl/visualization/pcl_visualizer.h>

#include <string>

namespace pcl_sq {

/** \brief Shows a union of superquadrics, each part in its partColor().
 *
 * The whole model is one mesh of the viewer: \a id goes to its removePolygonMesh(), and
 * to setPointCloudRenderingProperties() for the opacity.
 * \param[in] id name in the viewer, not taken yet \param[in] viewport 0: all
 * \return false if there is no part or the name is taken
 * \ingroup pcl_sq */
inline bool addSuperquadric(pcl::visualization::PCLVisualizer& viewer,
                            const MultiSuperquadric& model,
                            const std::string& id = "superquadric",
                            int viewport = 0) {
  if (model.empty())
    return false;
  pcl::PointCloud<pcl::PointXYZRGB> vertices;
  pcl::PolygonMesh mesh;
  for (std::size_t k = 0; k < model.size(); ++k) {
    const TriangleMesh part = meshSuperquadric(model.parts[k]);
    const Color color = partColor(k);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Eigen::Vector3d& v : part.vertices) {
      pcl::PointXYZRGB vertex;
      vertex.getVector3fMap() = v.cast<float>();
      vertex.r = color.r;
      vertex.g = color.g;
      vertex.b = color.b;
      vertices.push_back(vertex);
    }
    for (const auto& triangle : part.triangles) {
      mesh.polygons.emplace_back();
      for (const std::uint32_t corner : triangle)
        mesh.polygons.back().vertices.push_back(
            static_cast<pcl::index_t>(first + corner));
    }
  }
  pcl::toPCLPointCloud2(vertices, mesh.cloud);
  return viewer.addPolygonMesh(mesh, id, viewport);
}

/** \brief Shows one superquadric. */
inline bool addSuperquadric(pcl::visualization::PCLVisualizer& viewer,
                            const Superquadric& superquadric,
                            const std::string& id = "superquadric",
                            int viewport = 0) {
  MultiSuperquadric model;
  model.parts.push_back(superquadric);
  return addSuperquadric(viewer, model, id, viewport);
}

} // namespace pcl_sq
