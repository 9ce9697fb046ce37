// SPDX-License-Identifier: BSD-3-Clause
// Private. How much of a thing nothing hides.
#pragma once

#include "pcl_sq/scene_estimation.h"

namespace pcl_sq::detail {

/** \brief SceneObject::visible: of the image's pixels that the model covers, those that
 * show nothing nearer. \param[in] camera, points in the cloud's frame */
[[nodiscard]] double visibleShare(const SceneObject& object,
                                  const PinholeCamera& camera,
                                  const CloudPoints& points,
                                  const LabelImage& labels);

} // namespace pcl_sq::detail
