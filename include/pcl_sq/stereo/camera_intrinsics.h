// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <Eigen/Core>

#include <string>

namespace pcl_sq {

/** \brief Pinhole camera; x right, y down, z forward. Pixel centres lie on integers. */
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

/** \brief A rectified pair: the left camera and what turns disparity into depth. */
struct PCL_SQ_EXPORTS StereoIntrinsics : CameraIntrinsics {
  double baseline = 0.0; ///< distance of the cameras along x [m], positive
  double doffs = 0.0;    ///< right minus left principal point's x [px]

  /** \brief Depth f B / (d + doffs) [m]; not positive beyond infinity. */
  double depth(double disparity) const { return fx * baseline / (disparity + doffs); }
  /** \brief Disparity of a depth [px]. */
  double disparity(double depth) const { return fx * baseline / depth - doffs; }
  /** \brief As CameraIntrinsics::isValid, and a baseline between 1 mm and 10 m. */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

} // namespace pcl_sq
