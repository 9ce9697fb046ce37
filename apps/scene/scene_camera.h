// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/camera.h"

#include <Eigen/Core>

#include <array>

namespace pcl_sq::app {

/** \brief A camera of the rig, with OpenCV's lens model (k1 k2 p1 p2 k3). */
struct SceneCamera : CameraIntrinsics {
  std::array<double, 5> distortion{};                     ///< k1 k2 p1 p2 k3
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< rig to camera
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     ///< in the rig's frame [m]

  /** \brief Direction of the ray through pixel (u, v) in the rig's frame; its length
   * is chosen so that z = 1 in the camera's frame. */
  Eigen::Vector3d ray(double u, double v) const;
  /** \brief Pixel of a point of the rig's frame in front of the camera. */
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;
};

/** \brief Two parallel cameras: the Bumblebee-like rig of the paper; the rig's frame is
 * that of the left camera. */
struct StereoRig {
  SceneCamera left, right;
  double baseline = 0.12; ///< [m]
};
/** \brief Ideal rig: focal length [px], principal points in the image's middle. */
StereoRig makeRig(int width, int height, double focal_length, double baseline);
/** \brief The same place through real lenses: distorted, slightly turned cameras with
 * unequal focal lengths. */
StereoRig distorted(const StereoRig& ideal);

} // namespace pcl_sq::app
