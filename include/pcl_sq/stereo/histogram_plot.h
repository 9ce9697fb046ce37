// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/depth_histogram.h"

#include <opencv2/core/mat.hpp>

namespace pcl_sq {

/** \brief Picture of the depth histogram with its aperture (paper, Fig. 2b), BGR.
 * \param[in] disparity_scale focal length times baseline [px m], so that the axis shows
 * pixels of disparity; 0 shows depths only \param[in] size of the picture [px] */
PCL_SQ_EXPORTS cv::Mat plotDepthHistogram(const DepthHistogram& histogram,
                                          double disparity_scale = 0.0,
                                          const cv::Size& size = {640, 400});

} // namespace pcl_sq
