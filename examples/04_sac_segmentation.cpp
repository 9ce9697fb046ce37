// SPDX-License-Identifier: BSD-3-Clause
// Two things in one cloud by pcl::SACSegmentation: find one, take its points out, find
// the next.
#include <pcl_sq/superquadric_segmentation.h>
#include <pcl_sq/triangle_mesh.h>

#include <pcl/point_types.h>

#include <algorithm>
#include <iostream>
#include <numeric>

int main() {
  pcl_sq::Superquadric box, can;
  box.center = {-0.15, 0.1, 0.7};
  box.semi_axes = {0.06, 0.09, 0.03};
  box.epsilon1 = box.epsilon2 = 0.15;
  can.center = {0.15, 0.1, 0.7};
  can.semi_axes = {0.033, 0.033, 0.06};
  can.epsilon1 = 0.2;
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& thing : {box, can})
    for (const Eigen::Vector3d& p : pcl_sq::sampleUniform(thing, 1500))
      cloud->push_back({float(p.x()), float(p.y()), float(p.z())});
  for (int row = 0; row < 15; ++row) // a wall behind them
    for (int column = 0; column < 20; ++column)
      cloud->push_back(
          {-0.3F + 0.03F * float(column), -0.2F + 0.03F * float(row), 1.0F});

  pcl_sq::SuperquadricSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setDistanceThreshold(0.003); // [m]
  segmentation.setRadiusLimits(0.01, 0.15); // of the semi-axes [m]
  segmentation.setMaxIterations(60);
  auto rest = pcl::make_shared<pcl::Indices>(cloud->size());
  std::iota(rest->begin(), rest->end(), 0);
  for (int thing = 0; thing < 2; ++thing) {
    segmentation.setIndices(rest);
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    segmentation.segment(inliers, coefficients);
    if (inliers.indices.empty())
      return 1;
    std::cout << inliers.indices.size() << " points: "
              << pcl_sq::Superquadric::fromCoefficients(coefficients.values) << '\n';
    auto others = pcl::make_shared<pcl::Indices>();
    std::sort(inliers.indices.begin(), inliers.indices.end());
    std::set_difference(rest->begin(),
                        rest->end(),
                        inliers.indices.begin(),
                        inliers.indices.end(),
                        std::back_inserter(*others));
    rest = others;
  }
  return 0;
}
