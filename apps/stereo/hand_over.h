// SPDX-License-Identifier: BSD-3-Clause
// From what the images gave to the model half of the chain.
#pragma once

#include "options/model_options.h"
#include "stereo/stereo_front.h"

namespace pcl_sq::app {

/** \brief Takes the points under the object's mask that lie far from its box out of a
 * scene: false matches along the outline, with the depth of what is behind. */
void dropStrays(const StereoView& front, LoadedCloud& scene);

/** \brief Tells the model half what the images gave. The best mode looks at the whole
 * scene through the outline, the paper's chain at the object's points in their box. */
void handOver(const StereoView& front, bool whole_scene, ModelOptions& model);

} // namespace pcl_sq::app
