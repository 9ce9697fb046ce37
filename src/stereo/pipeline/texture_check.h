// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_reprojector.h"

namespace pcl_sq::detail {

/** \brief How much was matched by texture. */
struct TexturedShare {
  double of_pixels = 1.0;  ///< of the object's
  double of_matches = 1.0; ///< of its pixels that have a disparity
};

/** \brief Share of the object's inner pixels that were matched by their texture.
 *
 * Inner are those whose window lies on the object alone; at its outline the texture of
 * what is behind is matched. A match counts if the windows of both images have a
 * correlation above one half: less says that noise, which the images do not share, is
 * stronger than what they do.
 * \param[in] mask the object's pixels \param[in] block side of a window [px]
 * \return 0 to 1; 1 for what has hardly any inner pixel, for it cannot be judged */
PCL_SQ_EXPORTS TexturedShare texturedShare(const StereoResult& stereo,
                                           const cv::Mat& mask,
                                           int block);

} // namespace pcl_sq::detail
