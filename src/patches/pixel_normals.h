// SPDX-License-Identifier: BSD-3-Clause
// Private. Which way the surface faces at each pixel.
#pragma once

#include "patches/scene_view.h"

namespace pcl_sq::detail {

/** \brief Normals of the surfaces at the pixels that are set, towards the camera: of
 * the planes through the neighbours without a jump in depth between. Zero elsewhere,
 * and where the neighbours are too few.
 * \param[in] jump of inverse depths that parts neighbours, beside the steepest slope
 *            [1/m] */
[[nodiscard]] Eigen::Matrix3Xf
pixelNormals(const SceneView& view, const CellMask& pixels, double jump);

} // namespace pcl_sq::detail
