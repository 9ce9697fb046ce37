// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stereo/segmentation/color_models.h"

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace pcl_sq::detail {

/** \brief The part of a rectangle that lies in the image. */
cv::Rect clipped(const cv::Rect& rect, const cv::Mat& image);
/** \brief A rectangle with a margin on each side, at least 12 px, within the image.
 * \param[in] share of its sides */
cv::Rect grown(const cv::Rect& rect, double share, const cv::Mat& image);

/** \brief The object in a box, by colour histograms of the box's core and of its
 * surroundings. \param[in] window part of the image that is looked at
 * \return CV_8U of the window's size, as of the next one */
cv::Mat colorInBox(const cv::Mat& image, const cv::Rect& box, const cv::Rect& window);

/** \brief The object in a box by a graph cut on colours alone. */
cv::Mat cutInBox(const cv::Mat& image,
                 const cv::Rect& box,
                 const cv::Rect& window,
                 int iterations,
                 Border border);

/** \brief Sharpens a rough mask of the image: its inside is sure, its surroundings are
 * open. */
cv::Mat cutAroundMask(const cv::Mat& image,
                      const cv::Mat& rough,
                      double margin,
                      int iterations);

/** \brief Pixels whose colour is near a given one, in the Lab space. */
cv::Mat nearColor(const cv::Mat& bgr, const cv::Vec3b& color, double radius);

/** \brief Pixels that hang together with a place by colour: the colours of a patch
 * there, then of what they lead to. */
cv::Mat growColors(const cv::Mat& bgr, const cv::Point& place);

/** \brief Share of what depth takes for the object, but for its rim, that a mask has,
 * 0 to 1. */
double coverage(const cv::Mat& mask, const cv::Mat& likely);

} // namespace pcl_sq::detail
