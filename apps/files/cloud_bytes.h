// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <string>

namespace pcl_sq::app {

/** \brief A cloud as a PCD file, binary and compressed. \throw Failure if it is too
 * large for the format */
std::string pcdBytes(const pcl::PCLPointCloud2& cloud,
                     const Eigen::Vector4f& origin,
                     const Eigen::Quaternionf& orientation);

template <typename PointT>
std::string pcdBytes(const pcl::PointCloud<PointT>& cloud) {
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  return pcdBytes(blob, cloud.sensor_origin_, cloud.sensor_orientation_);
}

/** \brief A coloured cloud as a binary PLY file; an element "camera" tells the size of
 * its image, as PCL reads and writes it. */
std::string plyBytes(const pcl::PointCloud<pcl::PointXYZRGB>& cloud);

} // namespace pcl_sq::app
