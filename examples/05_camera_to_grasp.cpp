// SPDX-License-Identifier: BSD-3-Clause
// From a camera's cloud to the pose of a hand: object on a table -> superquadrics ->
// grasps. Usage: example_05_camera_to_grasp scene.pcd (an organized cloud)
#include <pcl_sq/grasp_planner.h>
#include <pcl_sq/object_surface_estimation.h>

#include <pcl/io/pcd_io.h>

#include <iostream>

int main(int argc, char** argv) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  if (argc != 2 || pcl::io::loadPCDFile(argv[1], *cloud) != 0)
    return 2;

  pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  pcl_sq::MultiSuperquadric object;
  if (!estimation.estimate(object))
    return 1;

  pcl_sq::GraspScene scene;
  scene.cloud = cloud->getMatrixXfMap(3, 4, 0).cast<double>(); // what is in the way
  scene.has_viewpoint = true;                                  // the camera: the origin
  if (const auto& table = estimation.getReport().view.table) {
    scene.has_table = true;
    scene.table_normal = table->normal;
    scene.table_offset = table->offset;
  }
  const pcl_sq::GraspPlan plan = pcl_sq::GraspPlanner().plan(object, scene);
  std::cout << plan.failure;
  if (!plan.ok())
    return 1;
  const pcl_sq::Grasp& best = plan.grasps.front();
  std::cout << "tool centre point " << best.position.transpose() << " m, approach "
            << best.approach().transpose() << ", close to " << 1e3 * best.width
            << " mm\n";
}
