// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/visualization/snapshot_renderer.h"

#include <vector>

namespace pcl_sq::test {

/** \brief What is seen where nothing is. */
inline const Color PAPER{255, 255, 255};

/** \brief A small picture of the scene alone. */
inline SnapshotOptions bareOptions(View view = View::ISO) {
  SnapshotOptions options;
  options.width = 320;
  options.height = 240;
  options.view = view;
  options.axes = options.scale_bar = options.legend = false;
  return options;
}

inline MultiSuperquadric modelOf(const std::vector<Superquadric>& parts) {
  return {parts};
}

inline Superquadric ballAt(double x, double y, double z, double radius) {
  Superquadric s;
  s.center = {x, y, z};
  s.semi_axes.setConstant(radius);
  return s;
}

} // namespace pcl_sq::test
