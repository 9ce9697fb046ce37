// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace pcl_sq::detail {

/** \brief How well colours tell a mask from what is beside it, 0.5 to 1. */
double separability(const cv::Mat& bgr, const cv::Mat& mask);

/** \brief Cuts a window into object and background.
 *
 * Each pixel brings the odds of its depth and those of its colour, which count for no
 * more than colours have been right on the pixels of known depth; neighbours stay
 * together but where the image has an edge. Outside of the box is background.
 * \param[in] bgr the window \param[in] box in the window
 * \param[in] depth_odds CV_32F, ln of the odds that a pixel is the object's by its
 * depth, 0 where nothing is known
 * \param[in] rounds of learning colours from the last cut
 * \return CV_8U of the window's size, 255 = object */
cv::Mat cutJointly(const cv::Mat& bgr,
                   const cv::Rect& box,
                   const cv::Mat& depth_odds,
                   int rounds);

} // namespace pcl_sq::detail
