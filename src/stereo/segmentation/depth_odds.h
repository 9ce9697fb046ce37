// SPDX-License-Identifier: BSD-3-Clause
// Private. What depth tells of a pixel in a box that was drawn around a thing.
#pragma once

#include "stereo/segmentation/depth_patches.h"

namespace pcl_sq::detail {

/** \brief Ln odds of a patch's cells, that they are the object's: what is as usual
 * around the box as in it tells nothing, and what goes on beyond it tells less where
 * the object ends. By depth, for another thing's end may come into the box, and hang
 * together with the object where matching blurs the step between them. \param[in]
 * object cells of the patch, CV_8U \param[in] box the box's cells, CV_8U \param[in]
 * thickness of a surface, by its scatter [m] \param[in] most of the odds \return
 * CV_32F, 0 where a cell is not the patch's */
cv::Mat oddsOfDepths(const DepthGrid& grid,
                     const cv::Mat& object,
                     const cv::Mat& box,
                     float thickness,
                     double most);

} // namespace pcl_sq::detail
