// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stereo/panel.h"

namespace pcl_sq::app {

/** \brief The image around the object with its mask's outline and its box. */
cv::Mat segmentTile(const PanelInput& input, const cv::Size& size);

/** \brief What the best mode took from the image: the outline, green where it is the
 * object's own and red where it is the image border's or an occluder's, and the lines
 * that touch it. */
cv::Mat outlineTile(const PanelInput& input, const cv::Size& size);

/** \brief The outline that the model would have, over the image. */
cv::Mat predictionTile(const PanelInput& input, const cv::Size& size);

} // namespace pcl_sq::app
