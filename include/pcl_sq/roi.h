// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

#include <Eigen/Core>

namespace pcl_sq {

/** \brief 2D query region in the image (paper, II-B, Fig. 2a). */
struct PixelRect {
  int x = 0, y = 0;          ///< left, top [px]
  int width = 0, height = 0; ///< [px]
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int column, int row) const {
    return column >= x && row >= y && static_cast<long long>(column) - x < width &&
           static_cast<long long>(row) - y < height;
  }
  bool operator==(const PixelRect& o) const {
    return x == o.x && y == o.y && width == o.width && height == o.height;
  }
};

/** \brief 3D query region: an axis-aligned box in the cloud's frame (Fig. 2c). The z
 * sides are the aperture's front and back. */
struct RoiBox {
  Eigen::Vector3d min = Eigen::Vector3d::Zero(); ///< [m]
  Eigen::Vector3d max = Eigen::Vector3d::Zero(); ///< [m]
  Eigen::Vector3d center() const { return 0.5 * (min + max); }
  Eigen::Vector3d sizes() const { return max - min; }
  bool contains(const Eigen::Vector3d& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
};

} // namespace pcl_sq
