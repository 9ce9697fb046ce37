// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_cloud.h"

#include "pcl_sq/multi_superquadric.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl_sq::test {

/** \brief An upright bottle, body and neck, in front of a camera: y down, z forward. */
inline MultiSuperquadric bottle() {
  MultiSuperquadric m;
  m.parts.resize(2);
  for (Superquadric& s : m.parts) {
    s.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    s.epsilon1 = 0.2;
  }
  m.parts[0].center = {0.05, 0.05, 0.9};
  m.parts[0].semi_axes = {0.035, 0.035, 0.1};
  m.parts[1].center = {0.05, -0.09, 0.9};
  m.parts[1].semi_axes = {0.013, 0.013, 0.045};
  return m;
}

/** \brief Points of the union's surface that a camera at the origin sees: those that
 * face it and lie in no other part. Normals decide, which is exact for convex parts
 * side by side. */
inline Eigen::Matrix3Xd visiblePoints(const MultiSuperquadric& model,
                                      std::size_t per_part,
                                      double sigma = 0.0,
                                      unsigned seed = 1) {
  std::vector<Eigen::Vector3d> kept;
  Random random(seed);
  for (std::size_t k = 0; k < model.size(); ++k)
    for (const Eigen::Vector3d& p : sampleUniform(model.parts[k], per_part, seed)) {
      bool visible = model.parts[k].normal(p).dot(p) < 0.0;
      for (std::size_t other = 0; other < model.size(); ++other)
        visible = visible && (other == k || model.parts[other].gauge(p) > 1.0);
      if (visible)
        kept.push_back(p + p.normalized() * random.normal(sigma));
    }
  return Eigen::Map<const Eigen::Matrix3Xd>(kept.front().data(), 3, kept.size());
}

inline pcl::PointCloud<pcl::PointXYZ>::Ptr toCloud(const Eigen::Matrix3Xd& points) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    cloud->push_back(
        pcl::PointXYZ(float(points(0, i)), float(points(1, i)), float(points(2, i))));
  return cloud;
}

} // namespace pcl_sq::test
