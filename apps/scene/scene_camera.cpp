// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_camera.h"

#include <Eigen/Geometry>

namespace pcl_sq::app {
namespace {

/** \brief OpenCV's distortion of a normalised image point. */
Eigen::Vector2d distort(const Eigen::Vector2d& p, const std::array<double, 5>& k) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  return {x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x),
          y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y};
}

Eigen::Matrix3d smallRotation(double x, double y, double z) {
  const Eigen::Vector3d w(x, y, z);
  return Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
}

} // namespace

Eigen::Vector3d SceneCamera::ray(double u, double v) const {
  const Eigen::Vector2d seen = backProject(u, v, 1.0).head<2>();
  Eigen::Vector2d p = seen;
  if (distortion != std::array<double, 5>{})
    for (int i = 0; i < 20; ++i) // fixed point; contracts for moderate lenses
      p += seen - distort(p, distortion);
  return rotation.transpose() * Eigen::Vector3d(p.x(), p.y(), 1.0);
}

Eigen::Vector2d SceneCamera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d c = rotation * (point - position);
  const Eigen::Vector2d p = distort(c.head<2>() / c.z(), distortion);
  return CameraIntrinsics::project({p.x(), p.y(), 1.0});
}

StereoRig makeRig(int width, int height, double focal_length, double baseline) {
  StereoRig rig;
  rig.left.width = width;
  rig.left.height = height;
  rig.left.fx = rig.left.fy = focal_length;
  rig.left.cx = 0.5 * (width - 1);
  rig.left.cy = 0.5 * (height - 1);
  rig.right = rig.left;
  rig.right.position.x() = baseline;
  rig.baseline = baseline;
  return rig;
}

StereoRig distorted(const StereoRig& ideal) {
  StereoRig rig = ideal;
  rig.left.fx *= 1.001;
  rig.left.fy *= 1.0;
  rig.left.cx += 2.5;
  rig.left.cy -= 3.0;
  rig.left.distortion = {-0.28, 0.11, 0.0006, -0.0004, 0.0};
  rig.left.rotation = smallRotation(0.004, -0.006, 0.003);
  rig.right.fx *= 0.998;
  rig.right.fy *= 0.997;
  rig.right.cx -= 3.0;
  rig.right.cy += 2.0;
  rig.right.distortion = {-0.26, 0.10, -0.0005, 0.0003, 0.0};
  rig.right.rotation = smallRotation(-0.005, 0.007, -0.004);
  return rig;
}

} // namespace pcl_sq::app
