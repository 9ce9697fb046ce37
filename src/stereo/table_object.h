// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace pcl_sq::detail {

/** \brief Rough mask of the largest object on a table, from an organized cloud in the
 * camera's frame (y down).
 *
 * The table is the largest plane that faces upwards, within 50 degrees; looking down
 * steeply, the largest plane of all. Objects are patches above it that depth jumps
 * separate; walls, which reach the image's border, are passed over if there is anything
 * else. \param[out] mask CV_8U of the cloud's size
 * \param[out] why the reason of a failure, a sentence \return whether there is one */
bool findTableObject(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                     cv::Mat& mask,
                     std::string& why);

} // namespace pcl_sq::detail
