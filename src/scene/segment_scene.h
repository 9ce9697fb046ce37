// SPDX-License-Identifier: BSD-3-Clause
// Private. Which pixels belong together: the things on a table, told apart.
#pragma once

#include "pcl_sq/impl/scene_estimation.hpp"

namespace pcl_sq::detail {

/** \brief An organized cloud in its camera's frame and what is known of it. */
struct SceneView {
  const CloudPoints& points;
  int width, height;
  const ColorMatrix& colors; ///< empty: none
  PinholeCamera camera;      ///< at the origin
  TableModel table;          ///< in the camera's frame
  unsigned int threads = 1;  ///< 0: all cores

  bool finite(int c) const { return points.col(c).allFinite(); }
  Eigen::Vector3d at(int c) const { return points.col(c).cast<double>(); }
};

/** \brief The things on the table, told apart. */
struct SceneSegments {
  LabelImage labels;          ///< from 1 on, 0: no thing
  std::vector<bool> outlined; ///< of each label: its outline is one of colours
};

/** \brief Tells the things on the table apart. */
[[nodiscard]] SceneSegments segmentScene(const SceneView& view, int min_pixels);

} // namespace pcl_sq::detail
