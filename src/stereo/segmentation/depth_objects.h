// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace pcl_sq::detail {

using ColorCloud = pcl::PointCloud<pcl::PointXYZRGB>;

/** \brief Rough mask of the largest object on a table, as findStandingObject() finds it
 * in an organized cloud in the camera's frame (y down).
 * \param[out] mask CV_8U of the cloud's size
 * \param[out] why the reason of a failure, a sentence \return whether there is one */
bool findTableObject(const ColorCloud& cloud, cv::Mat& mask, std::string& why);

/** \brief What depth says of the pixels of a box that holds an object, from an
 * organized cloud.
 *
 * The patch of connected depths, above the plane around the box if there is one, that
 * fills most of the box's middle is the object, with what lies in the box at its depth;
 * other depths are not. Near the border between the two, windows of the matcher may
 * have taken either for the other. \param[in] window part of the image around the box
 * \param[in] disparity_scale disparity times depth [px m], 0 if no pair was matched
 * \param[out] odds CV_32F of the window's size: ln of the odds that a pixel is the
 * object's, 0 where nothing is known \return false if no patch stands out */
bool depthOddsInBox(const ColorCloud& cloud,
                    const cv::Rect& box,
                    const cv::Rect& window,
                    double disparity_scale,
                    cv::Mat& odds);

/** \brief Rough mask of the patch of connected depths above the table under a pixel.
 * \return false if there is none, or one that is no object: cut by the image's border,
 * tiny, or a quarter of the image */
bool findObjectAt(const ColorCloud& cloud, const cv::Point& pixel, cv::Mat& mask);

/** \brief Share of a mask's points that lie about as far away as a patch's, 0 to 1; 1
 * without points. \param[in] patch, mask CV_8U of the cloud's size */
double
shareAtDepthOf(const ColorCloud& cloud, const cv::Mat& patch, const cv::Mat& mask);

} // namespace pcl_sq::detail
