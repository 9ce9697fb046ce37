// SPDX-License-Identifier: BSD-3-Clause
// Private. Which pixels belong together: the things on a table, told apart.
#pragma once

#include "patches/scene_view.h"

namespace pcl_sq::detail {

/** \brief The things on the table, told apart. */
struct SceneSegments {
  LabelImage labels;          ///< from 1 on, 0: no thing
  std::vector<bool> outlined; ///< of each label: its outline is one of colours
};

/** \brief Tells the things on the table apart. */
[[nodiscard]] SceneSegments segmentScene(const SceneView& view, int min_pixels);

} // namespace pcl_sq::detail
