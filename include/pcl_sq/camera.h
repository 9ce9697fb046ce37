// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <Eigen/Core>

#include <string>

namespace pcl_sq {

/** \brief A pinhole camera in its own frame: pixel = (fx X / Z + cx, fy Y / Z + cy),
 * pixel centres at whole numbers, x to the right, y down, z forward. */
struct PCL_SQ_EXPORTS CameraIntrinsics {
  int width = 0, height = 0; ///< image size [px], 0 = unknown
  double fx = 0.0, fy = 0.0; ///< focal lengths [px], positive
  double cx = 0.0, cy = 0.0; ///< principal point [px]

  /** \brief The point at depth \a z [m] seen by pixel (u, v). */
  Eigen::Vector3d backProject(double u, double v, double z) const {
    return {(u - cx) / fx * z, (v - cy) / fy * z, z};
  }
  /** \brief Pixel of a point in front of the camera. */
  Eigen::Vector2d project(const Eigen::Vector3d& p) const {
    return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy};
  }
  /** \brief Whether the numbers are finite, the focal lengths positive and the
   * principal point is near the image. \param[out] why the first violation */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief The same with a place in the frame of a cloud. */
struct PCL_SQ_EXPORTS PinholeCamera : CameraIntrinsics {
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the cloud's frame [m]
  /** \brief Columns: the camera's axes in the cloud's frame. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  /** \brief As CameraIntrinsics::isValid, and a finite pose.
   * \param[out] why the first violation as a sentence (optional) */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
  /** \brief Depth of a point along the optical axis [m]. */
  double depthOf(const Eigen::Vector3d& point) const {
    return rotation.col(2).dot(point - center);
  }
  /** \brief The point's pixel; meaningful for a positive depth only. */
  Eigen::Vector2d project(const Eigen::Vector3d& point) const;
  /** \brief Unit direction of a pixel's viewing ray in the cloud's frame. */
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
  /** \brief A camera at \a center that looks at \a target. */
  static PinholeCamera lookingAt(const Eigen::Vector3d& center,
                                 const Eigen::Vector3d& target,
                                 double focal_length);
};

} // namespace pcl_sq
