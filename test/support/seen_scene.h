// SPDX-License-Identifier: BSD-3-Clause
// Tables with things as SceneEstimation sees them, and what is true of them.
#pragma once

#include "pcl_sq/scene_estimation.h"

#include "table_scene.h"

#include <pcl/point_types.h>

#include <gtest/gtest.h>

namespace pcl_sq::test {

/** \brief Twice the pixels of TableScene's camera, so that small things have enough. */
inline TableScene fineScene() {
  TableScene scene(600.0);
  scene.width = 320;
  scene.height = 240;
  scene.camera.cx = 159.5;
  scene.camera.cy = 119.5;
  return scene;
}

/** \brief Thing of each pixel, from 1 on; 0 for the table. */
inline LabelImage truthOf(const TableScene& scene) {
  LabelImage labels(scene.width, scene.height);
  const Eigen::Vector3d& eye = scene.camera.center;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const Eigen::Vector3d ray = scene.camera.ray({double(x), double(y)});
      double nearest = -eye.z() / ray.z();
      nearest = nearest > 0.0 ? nearest : 1e9;
      for (std::size_t k = 0; k < scene.things.size(); ++k)
        if (const double t = firstHit(scene.things[k], eye, ray); t < nearest) {
          nearest = t;
          labels.values[std::size_t(y * scene.width + x)] = std::uint16_t(k + 1);
        }
    }
  return labels;
}

inline pcl::PointCloud<pcl::PointXYZRGB>::Ptr
cloudOf(const TableScene& scene, const Eigen::Matrix3Xf& points, bool colored) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>(
      std::uint32_t(scene.width), std::uint32_t(scene.height));
  const LabelImage labels = truthOf(scene);
  const std::uint8_t colors[4][3] = {
      {140, 140, 130}, {200, 60, 50}, {50, 90, 190}, {60, 170, 70}};
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].getVector3fMap() = points.col(Eigen::Index(i));
    const auto& color = colors[colored ? labels.values[i] % 4 : 0];
    (*cloud)[i].r = color[0];
    (*cloud)[i].g = color[1];
    (*cloud)[i].b = color[2];
  }
  return cloud;
}

/** \brief Largest distance of the models' centres above the table to the truth's, each
 * to the nearest [m]. */
inline double
farthest(const Scene& scene, const TableScene& truth, const PinholeCamera& to) {
  double most = 0.0;
  for (const Superquadric& thing : truth.things) {
    const Eigen::Vector3d at = to.rotation.transpose() * (thing.center - to.center);
    double nearest = 1e9;
    for (const SceneObject& object : scene.objects)
      nearest = std::min(nearest, (object.model.boundingBox().center() - at).norm());
    most = std::max(most, nearest);
  }
  return most;
}

inline Scene estimate(const pcl::PointCloud<pcl::PointXYZRGB>::Ptr& cloud,
                      const LabelImage& labels = {},
                      unsigned int threads = 0) {
  SceneEstimation<pcl::PointXYZRGB> estimation;
  estimation.setInputCloud(cloud);
  estimation.setLabels(labels);
  estimation.setNumberOfThreads(threads);
  Scene scene;
  const bool found = estimation.estimate(scene);
  EXPECT_EQ(found, scene.failure.empty());
  EXPECT_EQ(found, !scene.objects.empty());
  return scene;
}

} // namespace pcl_sq::test
