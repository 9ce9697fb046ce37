// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_options.h"

#include <opencv2/calib3d.hpp>

namespace pcl_sq::detail {

/** \brief Matches both ways and smooths the disparities along the left image's edges.
 * \param[out] fixed sixteenths of a pixel \param[out] confidence of each, 0 to 255 */
using WlsFilter = void(const cv::Mat& left,
                       const cv::Mat& right,
                       const cv::Mat& guide,
                       const cv::Ptr<cv::StereoMatcher>& matcher,
                       const StereoOptions& options,
                       cv::Mat& fixed,
                       cv::Mat& confidence);

/** \brief The filter of opencv_ximgproc, which brings OpenCV's codecs with it: where
 * libraries are shared it is a plug-in that is loaded at the first call. \return null
 * where pcl_sq was built without that module \throws pcl_sq::Exception if it cannot be
 * loaded */
WlsFilter* wlsFilter();

} // namespace pcl_sq::detail

/** \brief The one function of the plug-in. */
extern "C" PCL_SQ_EXPORTS pcl_sq::detail::WlsFilter* pcl_sq_wls_filter();
