// SPDX-License-Identifier: BSD-3-Clause
// Private. Disparities beyond the matcher's sixteenths.
#pragma once

#include <opencv2/core.hpp>

namespace pcl_sq::detail {

constexpr int EXPOSURE_WINDOW = 41;  ///< in which the cameras' exposures agree [px]
constexpr int NOISE_WINDOW = 15;     ///< in which the grey values' variance is taken
constexpr float MIN_VARIANCE = 0.5F; ///< of grey values: they are whole numbers

/** \brief Least-squares matching with slanted windows.
 *
 * Block matching compares windows that face the camera: on slants and near outlines its
 * minimum lies beside the truth, and what it interpolates leans towards whole pixels.
 * Here each pixel's window carries a plane of disparities d(u, v), which makes the grey
 * values agree, sum of (L(u, v) - R(u - d(u, v), v))^2 smallest (Foerstner 1982; Gruen
 * 1985); neighbours that lie off the plane, on another surface, do not take part. Where
 * texture is weak the matcher's own disparities hold the plane.
 * \param[in] left,right rectified, CV_8U
 * \param[in,out] disparity CV_32F [px], NaN = missing; pixels whose window cannot be
 * brought to agreement near their disparity become NaN */
void refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity);

} // namespace pcl_sq::detail
