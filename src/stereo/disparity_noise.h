// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

namespace pcl_sq::detail {

/** \brief How far the disparities of a pair err. */
struct DisparityNoise {
  cv::Mat sigma; ///< CV_32F, standard deviation of each disparity [px]
  /** \brief Side of the square of pixels that share one error [px]. */
  double correlation = 7.0;
};

/** \brief Measures the noise of a rectified pair by the pair itself.
 *
 * Rectified images match in their own rows: what a match across the rows finds is error
 * alone, of the same matching, texture, lenses and calibration as that of the
 * disparities. Its scatter as a function of what the texture leaves open gives the
 * disparities' standard deviation at their own texture, its smoothness how many
 * neighbours share one error.
 * \param[in] left, right CV_8U grey \param[in] disparity CV_32F [px], NaN = missing */
DisparityNoise
measureNoise(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity);

} // namespace pcl_sq::detail
