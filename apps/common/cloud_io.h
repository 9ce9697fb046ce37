// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace pcl_sq::app {

/** \brief A cloud as every program uses it. */
struct LoadedCloud {
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr cloud; ///< NaN where there is no point
  bool has_color = false;
  std::size_t finite_points = 0;
};

/** \brief Reads PCD, PLY, OBJ (vertices) or XYZ (text, three numbers a line).
 *
 * What the header promises is held against the file's size first, so that a lying or
 * truncated file is an error and not a memory blow-up.
 * \throw Failure with one sentence */
LoadedCloud loadCloud(const std::string& path);

} // namespace pcl_sq::app
