// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/cell_mask.h"

#include <Eigen/Core>

namespace pcl_sq {

/** \brief 3D query region, what a rectangle of pixels (CellRect; paper, II-B, Fig. 2a)
 * becomes: an axis-aligned box in the cloud's frame (Fig. 2c). The z
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
