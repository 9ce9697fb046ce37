// SPDX-License-Identifier: BSD-3-Clause
// Several things on a table: PCL finds the table and the clusters above it, pcl_sq a
// superquadric model of each.
#include <pcl_sq/object_surface_estimation.h>
#include <pcl_sq/triangle_mesh.h>

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/impl/extract_clusters.hpp> // without PCL's library, or VTK

#include <cmath>
#include <cstdio>
#include <random>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

// the camera is at the origin and looks along z, y points down; it is tilted by TILT
constexpr double TILT = 0.6; // [rad]
const Eigen::Vector3d UP(0.0, -std::cos(TILT), -std::sin(TILT));
const Eigen::Vector3d MIDDLE(0.0, 0.0, 0.9); // of the table [m]

/** \brief Something that stands on the table, \a side metres right of its middle. */
pcl_sq::Superquadric standing(double side,
                              const Eigen::Vector3d& semi_axes,
                              double epsilon1,
                              double epsilon2) {
  pcl_sq::Superquadric s;
  s.semi_axes = semi_axes;
  s.epsilon1 = epsilon1;
  s.epsilon2 = epsilon2;
  s.rotation.col(2) = UP;
  s.rotation.col(0) = Eigen::Vector3d::UnitX();
  s.rotation.col(1) = UP.cross(Eigen::Vector3d::UnitX());
  s.center = MIDDLE + side * Eigen::Vector3d::UnitX() + semi_axes.z() * UP;
  return s;
}

/** \brief The sides of the things that the camera sees, and the table. */
Cloud::Ptr sceneOf(const std::vector<pcl_sq::Superquadric>& things) {
  auto cloud = pcl::make_shared<Cloud>();
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.0005);
  const auto add = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = p + noise(engine) * p.normalized();
    cloud->push_back({float(q.x()), float(q.y()), float(q.z())});
  };
  for (const auto& thing : things)
    for (const Eigen::Vector3d& p : pcl_sq::sampleUniform(thing, 3000))
      if (thing.normal(p).dot(p) < 0.0)
        add(p);
  const Eigen::Vector3d away = UP.cross(Eigen::Vector3d::UnitX());
  for (int i = -58; i <= 58; ++i)
    for (int k = -33; k <= 33; ++k)
      add(MIDDLE + 0.006 * i * Eigen::Vector3d::UnitX() + 0.006 * k * away);
  return cloud;
}

} // namespace

int main() {
  const std::vector<pcl_sq::Superquadric> things = {
      standing(-0.2, {0.033, 0.033, 0.06}, 0.2, 1.0), // a can
      standing(0.0, {0.05, 0.03, 0.07}, 0.2, 0.2),    // a box
      standing(0.2, {0.04, 0.04, 0.04}, 1.0, 1.0)};   // a ball
  const Cloud::Ptr cloud = sceneOf(things);

  // the table: PCL's plane, its normal turned towards the camera
  const auto plane =
      pcl::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(cloud);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(plane, 0.004);
  Eigen::VectorXf coefficients;
  if (!ransac.computeModel())
    return 1;
  ransac.getModelCoefficients(coefficients);
  const auto table = pcl_sq::TablePlane::fromCoefficients(coefficients);
  if (!table)
    return 1;

  // the clusters of what is above it
  auto above = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (table->signedDistance((*cloud)[i].getVector3fMap().cast<double>()) > 0.006)
      above->push_back(int(i));
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setIndices(above);
  extraction.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  extraction.setClusterTolerance(0.02);
  extraction.setMinClusterSize(100);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  // one model each: exactly the cluster's points, standing on that table
  pcl_sq::EstimationOptions options;
  options.view.table = pcl_sq::TableModel{*table};
  options.view.viewpoint = Eigen::Vector3d::Zero();
  pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setOptions(options);
  estimation.setInputCloud(cloud);
  std::size_t models = 0;
  std::puts("points  parts  at x, y, z [m]         height  largest width [mm]");
  for (const pcl::PointIndices& cluster : clusters) {
    estimation.setIndices(pcl::make_shared<pcl::Indices>(cluster.indices));
    pcl_sq::MultiSuperquadric model;
    if (!estimation.estimate(model))
      continue;
    ++models;
    double width = 0.0; // support() measures from the origin, so of both sides
    for (int k = 0; k < 32; ++k) {
      const Eigen::Vector3d direction =
          Eigen::AngleAxisd(0.1 * k, table->normal) * Eigen::Vector3d::UnitX();
      width = std::max(width, model.support(direction) + model.support(-direction));
    }
    const Eigen::Vector3d center = model.boundingBox().center();
    std::printf("%6zu  %5zu  %6.3f %6.3f %6.3f  %6.1f  %6.1f\n",
                cluster.indices.size(),
                model.size(),
                center.x(),
                center.y(),
                center.z(),
                1e3 * (model.support(table->normal) + table->offset),
                1e3 * width);
  }
  return models == things.size() ? 0 : 1;
}
