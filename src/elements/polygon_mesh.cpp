// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/polygon_mesh.h"

#include <pcl/conversions.h>
#include <pcl/point_types.h>

namespace pcl_sq {

pcl::PolygonMesh toPolygonMesh(const TriangleMesh& mesh) {
  pcl::PointCloud<pcl::PointXYZ> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices)
    vertices.push_back(pcl::PointXYZ(float(v.x()), float(v.y()), float(v.z())));
  pcl::PolygonMesh result;
  pcl::toPCLPointCloud2(vertices, result.cloud);
  result.polygons.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    result.polygons[i].vertices.assign(mesh.triangles[i].begin(),
                                       mesh.triangles[i].end());
  return result;
}

pcl::PolygonMesh toPolygonMesh(const Superquadric& superquadric, int divisions) {
  return toPolygonMesh(meshSuperquadric(superquadric, divisions));
}

pcl::PolygonMesh toPolygonMesh(const MultiSuperquadric& model, int resolution) {
  return toPolygonMesh(model.meshUnion(resolution));
}

} // namespace pcl_sq
