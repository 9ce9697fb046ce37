// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <optional>
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

/** \brief Where a cloud was seen from, as far as the file tells: from its rays, if it
 * is an image, or its VIEWPOINT. Nothing where the file says the origin: so do files
 * whose writers did not care. */
std::optional<Eigen::Vector3d> viewpointOf(const LoadedCloud& input);

/** \brief The coordinates where they are, as columns. */
CloudPoints coordinatesOf(const LoadedCloud& input);

} // namespace pcl_sq::app
