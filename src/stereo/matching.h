// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_options.h"

#include <opencv2/core/mat.hpp>

namespace pcl_sq::detail {

constexpr double DISPARITY_STEP = 1.0 / 16.0; ///< of OpenCV's matchers [px]

/** \brief Searched disparities [low, low + count) [px]; count a multiple of 16. */
struct DisparityRange {
  int low = 0;
  int count = 0;
};

/** \brief Smallest range that holds [low, high]. */
DisparityRange rangeOf(double low, double high);

/** \brief Disparities of a rectified grey pair, CV_32F [px], NaN where missing.
 * \param[in] guide the left colour image, for the edge-aware filter */
cv::Mat matchPair(const cv::Mat& left,
                  const cv::Mat& right,
                  const cv::Mat& guide,
                  const DisparityRange& range,
                  const StereoOptions& options);

/** \brief Range that holds the scene's disparities, found on reduced images; count 0
 * when nothing matches. \param[in] limits range that may be searched */
DisparityRange
findRange(const cv::Mat& left, const cv::Mat& right, const DisparityRange& limits);

/** \brief Shares of pixels that match in the given order and in the other one. */
struct OrderVotes {
  double given = 0.0, exchanged = 0.0;
  bool exchangedWins() const { return exchanged > 0.05 && exchanged > 3.0 * given; }
};
OrderVotes voteOnOrder(const cv::Mat& left, const cv::Mat& right);

/** \brief Grey values, CV_8U. */
cv::Mat toGrey(const cv::Mat& image);

} // namespace pcl_sq::detail
