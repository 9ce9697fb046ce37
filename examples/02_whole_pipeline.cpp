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
  for (int i = -60; i < 60; ++i)
    for (int k = 0; k < 120; ++k) {
      const auto x = 0.005F * float(i), z = 0.7F + 0.005F * float(k);
      cloud->push_back(pcl::PointXYZ(x, 0.1F, z));
    }
  const auto addWall = [&](float radius, float top, int rows) {
    for (int i = 0; i < rows; ++i)
      for (int k = 0; k < 60; ++k) {
        const auto y = top + 0.002F * float(i), angle = 3.2F + 0.05F * float(k);
        cloud->push_back(pcl::PointXYZ(
            radius * std::cos(angle), y, 1.0F + radius * std::sin(angle)));
      }
  };
  addWall(0.05F, -0.03F, 65); // the jar
  addWall(0.04F, -0.08F, 25); // its neck
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
