// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/drawing/scene.h"

namespace pcl_sq {

/** \brief The clouds as they are drawn. */
struct StyledPoints {
  std::vector<Eigen::Vector3d> points; ///< [m]
  std::vector<Color> colors;
  double size = 1.0; ///< diameter [px]
};

/** \brief Points of the object in full colour, its surroundings fading into the
 * background, and nothing behind. \param[in] box of what the picture frames */
StyledPoints styleClouds(const SnapshotScene& scene,
                         const ViewCamera& camera,
                         const Eigen::AlignedBox3d& box);

} // namespace pcl_sq
