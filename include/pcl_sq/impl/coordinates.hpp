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

} // namespace detail
} // namespace pcl_sq
