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

  bool finite(int c) const { return points.col(c).allFinite(); }
  Eigen::Vector3d at(int c) const { return points.col(c).cast<double>(); }
};

/** \brief Tells the things on the table apart.
 * \return labels from 1 on, 0: no thing */
[[nodiscard]] LabelImage segmentScene(const SceneView& view, int min_pixels);

} // namespace pcl_sq::detail
