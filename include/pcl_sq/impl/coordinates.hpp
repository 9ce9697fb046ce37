// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

#include <pcl/pcl_base.h>

namespace pcl_sq {
namespace detail {

/** \brief A cloud's coordinates as columns, where they are: what functions that are no
 * templates work on. */
using CoordinateMap = Eigen::Map<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>>;

/** \brief The coordinates of a cloud. \tparam PointT point type with float x, y, z */
template <typename PointT>
CoordinateMap coordinatesOf(const pcl::PointCloud<PointT>& cloud) {
  static_assert(sizeof(PointT) % sizeof(float) == 0,
                "points must lie at whole floats; do not pack the point type");
  return {cloud.empty() ? nullptr : &cloud.points.front().x,
          3,
          static_cast<Eigen::Index>(cloud.size()),
          Eigen::OuterStride<>(sizeof(PointT) / sizeof(float))};
}

/** \brief What is wrong with a cloud or with the indices handed to setIndices(), a
 * sentence; null if nothing is. PCL's classes read what indices name without a look,
 * also outside of the cloud: such as indices that are those of the cloud before. */
inline const char* contradictionOf(std::size_t points,
                                   std::size_t width,
                                   std::size_t height,
                                   const pcl::Indices& indices) {
  if (height > 1 && width * height != points)
    return "the cloud's width times its height is not the number of its points; set "
           "both, or a height of 1 for a list";
  for (const auto index : indices)
    if (static_cast<std::size_t>(index) >= points) // negative ones, too
      return "an index is that of no point of the cloud; hand this cloud's to "
             "setIndices()";
  return nullptr;
}
template <typename PointT>
const char* contradictionOf(const pcl::PointCloud<PointT>& cloud,
                            const pcl::Indices& indices) {
  return contradictionOf(cloud.size(), cloud.width, cloud.height, indices);
}

/** \brief Points in a row of an image; of a list all, whatever its width says. */
template <typename PointT>
int columnsOf(const pcl::PointCloud<PointT>& cloud) {
  return static_cast<int>(cloud.height > 1 ? cloud.width : cloud.size());
}

} // namespace detail
} // namespace pcl_sq
