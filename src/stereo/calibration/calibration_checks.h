// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_calibration.h"

#include <string>

namespace pcl_sq::detail {

/** \brief Throws an Exception of a method of StereoCalibration. */
[[noreturn]] void raiseCalibration(const std::string& method, const std::string& what);

/** \brief "width x height". */
std::string sizeText(int width, int height);

// Each throws a pcl_sq::Exception that names the matrix and says what is wrong.
void checkShape(const cv::Mat& m, int rows, int cols, const std::string& name);
void checkRotation(const cv::Mat& m, const std::string& name);
void checkCamera(const cv::Mat& m,
                 const cv::Mat& d,
                 bool fisheye,
                 const std::string& number);
void checkIntrinsics(const StereoIntrinsics& intrinsics);

/** \brief Left camera and baseline of a rectified pair of projections; the offset f B
 * may stand in either of them. */
StereoIntrinsics fromProjections(const cv::Mat& P1, const cv::Mat& P2);

} // namespace pcl_sq::detail
