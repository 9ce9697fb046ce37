// SPDX-License-Identifier: BSD-3-Clause
// Private. Whether two sets of points are one body's surface or two bodies'.
#pragma once

#include "scene/segment_scene.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief By how much one body explains two sets of pixels better than a body for each:
 * the difference of the scores of M17, positive for one body. */
[[nodiscard]] double gainOfOneBody(const SceneView& view,
                                   const std::vector<int>& first,
                                   const std::vector<int>& second);

} // namespace pcl_sq::detail
