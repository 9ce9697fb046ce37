// SPDX-License-Identifier: BSD-3-Clause
// The paper in one class: the visible side of a bottle in, a union of superquadrics
// out.
#include <pcl_sq/object_surface_estimation.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <iostream>

namespace {

// The front half of an upright can as a camera sees it, x right, y down, z forward [m].
void addCan(double radius,
            double top,
            double bottom,
            pcl::PointCloud<pcl::PointXYZ>& cloud) {
  for (double y = top; y < bottom; y += 0.002)
    for (double angle = -1.4; angle <= 1.4; angle += 0.05)
      cloud.emplace_back(radius * std::sin(angle), y, 1.0 - radius * std::cos(angle));
}

} // namespace

int main() {
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  addCan(0.035, 0.0, 0.18, *cloud);  // body
  addCan(0.012, -0.09, 0.0, *cloud); // neck

  pcl_sq::EstimationOptions options;
  options.paper_fit.axis_assignment = pcl_sq::AxisAssignment::BEST_OF_3;
  pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setOptions(options);
  estimation.setInputCloud(cloud);
  pcl_sq::MultiSuperquadric model;
  if (!estimation.estimate(model))
    return 1; // a PCL_WARN has said why

  for (const pcl_sq::Superquadric& part : model.parts)
    std::cout << "centre " << part.center.transpose() << " m, semi-axes "
              << part.semi_axes.transpose() << " m, exponents " << part.epsilon1 << ' '
              << part.epsilon2 << '\n';
  const pcl_sq::EstimationReport& report = estimation.getReport();
  std::cout << cloud->size() << " points, " << model.size()
            << " superquadrics, rms distance " << 1000.0 * report.rms_distance
            << " mm, " << report.grasp_indices.size() << " points to grasp at\n";
  return 0;
}
