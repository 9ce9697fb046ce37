// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/camera.h"

#include <string>

namespace pcl_sq {

/** \brief A rectified pair: the left camera and what turns disparity into depth. */
struct PCL_SQ_EXPORTS StereoIntrinsics : CameraIntrinsics {
  static constexpr double SMALLEST_BASELINE = 1e-3; ///< that is plausible [m]
  static constexpr double LARGEST_BASELINE = 10.0;  ///< that is plausible [m]

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
