// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/cloud_options.h"

#include "pcl_sq/superquadric.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_sq::app {

struct Shape;

/** \brief A cloud as every program uses it. */
struct LoadedCloud {
  pcl::PointCloud<pcl::PointXYZRGBA>::Ptr cloud; ///< [m]; NaN where there is no point
  bool has_color = false;
  std::size_t finite_points = 0;
  /** \brief Was taken off all coordinates [m]: floats would lose the digits of
   * georeferenced ones. Zero for all others; results are to have it put back. */
  Eigen::Vector3d offset{0.0, 0.0, 0.0};
  /** \brief What the user should know, sentences without their full stop. */
  std::vector<std::string> notes;
};

/** \brief Reads a file of points or triangles, "-" for standard input, as it stands.
 * \throw Failure with one sentence */
Shape loadShape(const std::string& path);

/** \brief Reads PCD, PLY, OBJ, STL or text with three numbers a line, "-" for standard
 * input. Files with faces are surfaces: points are sampled on them.
 * \throw Failure with one sentence */
LoadedCloud loadCloud(const std::string& path, const CloudOptions& options = {});

/** \brief As loadCloud(), without telling the user LoadedCloud::notes. */
LoadedCloud readCloud(const std::string& path, const CloudOptions& options = {});

/** \brief The same from bytes. \throw Failure, without the file's name in it */
LoadedCloud makeCloud(Shape shape, const CloudOptions& options);

/** \brief Where a cloud was seen from, as far as the file tells: from its rays, if it
 * is an image, or its VIEWPOINT. Nothing where the file says the origin: so do files
 * whose writers did not care. */
std::optional<Eigen::Vector3d> viewpointOf(const LoadedCloud& input);

/** \brief The coordinates where they are, as columns. */
CloudPoints coordinatesOf(const LoadedCloud& input);

} // namespace pcl_sq::app
