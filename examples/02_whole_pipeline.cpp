// SPDX-License-Identifier: BSD-3-Clause
// A cloud as a camera sees it: object on a table -> its points -> superquadrics ->
// grasp points.
#include <pcl_sq/object_surface_estimation.h>
#include <pcl_sq/tabletop_segmentation.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <iostream>

namespace {

/** \brief A jar on a table, seen from the front: x right, y down, z forward [m]. */
pcl::PointCloud<pcl::PointXYZ>::Ptr jarOnTable() {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (float x = -0.3F; x < 0.3F; x += 0.005F)
    for (float z = 0.7F; z < 1.3F; z += 0.005F)
      cloud->push_back(pcl::PointXYZ(x, 0.1F, z));
  const auto addWall = [&](float radius, float top, float bottom) {
    for (float y = top; y < bottom; y += 0.002F)
      for (float angle = 3.2F; angle < 6.2F; angle += 0.05F)
        cloud->push_back(pcl::PointXYZ(
            radius * std::cos(angle), y, 1.0F + radius * std::sin(angle)));
  };
  addWall(0.05F, -0.03F, 0.1F);   // the jar
  addWall(0.04F, -0.08F, -0.03F); // its neck
  return cloud;
}

} // namespace

int main() {
  const auto cloud = jarOnTable();

  pcl::IndicesPtr object(new pcl::Indices);
  pcl_sq::TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(cloud);
  if (!tabletop.segment(*object)) {
    std::cerr << tabletop.getFailure() << '\n';
    return 1;
  }

  pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(object);
  pcl_sq::MultiSuperquadric model;
  if (!estimation.estimate(model)) {
    std::cerr << estimation.getReport().failure << '\n';
    return 1;
  }
  std::cout << model << '\n'
            << estimation.getReport().grasp_indices.size()
            << " points where a gripper may touch\n";
  return 0;
}
