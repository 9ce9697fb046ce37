// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/camera.h"

#include "util/option_check.h"

#include <Eigen/Geometry>

#include <cmath>

namespace pcl_sq {

bool CameraIntrinsics::isValid(std::string* why) const {
  if (!std::isfinite(fx + fy + cx + cy))
    return detail::refuse(why, "a number of the camera is not finite");
  if (fx <= 0.0 || fy <= 0.0)
    return detail::refuse(why, "the focal length must be positive");
  if (width < 0 || height < 0)
    return detail::refuse(why, "the image size must not be negative");
  // An off-centre crop is fine; a principal point far outside is another image's.
  const bool known = width > 0 && height > 0;
  if (known && (cx < -0.5 * width || cx > 1.5 * width || cy < -0.5 * height ||
                cy > 1.5 * height))
    return detail::refuse(
        why,
        "the principal point (" + std::to_string(cx) + ", " + std::to_string(cy) +
            ") lies far outside of an image of " + std::to_string(width) + " x " +
            std::to_string(height) + " px");
  return true;
}

bool PinholeCamera::isValid(std::string* why) const {
  if (!CameraIntrinsics::isValid(why))
    return false;
  if (!center.allFinite() || !rotation.allFinite())
    return detail::refuse(why, "the camera's pose must be finite");
  return true;
}

Eigen::Vector2d PinholeCamera::project(const Eigen::Vector3d& point) const {
  return CameraIntrinsics::project(rotation.transpose() * (point - center));
}

Eigen::Vector3d PinholeCamera::ray(const Eigen::Vector2d& pixel) const {
  return rotation * backProject(pixel.x(), pixel.y(), 1.0).normalized();
}

PinholeCamera PinholeCamera::lookingAt(const Eigen::Vector3d& center,
                                       const Eigen::Vector3d& target,
                                       double focal_length) {
  PinholeCamera camera;
  camera.fx = camera.fy = focal_length;
  camera.center = center;
  const Eigen::Vector3d forward = (target - center).normalized();
  const Eigen::Vector3d right = forward.unitOrthogonal();
  camera.rotation.col(0) = right;
  camera.rotation.col(1) = forward.cross(right);
  camera.rotation.col(2) = forward;
  return camera;
}

} // namespace pcl_sq
