// SPDX-License-Identifier: BSD-3-Clause
// From what the images gave to the model half of the chain.
#pragma once

#include "options/model_options.h"
#include "stereo/stereo_front.h"

namespace pcl_sq::app {

/** \brief Takes the points under the object's mask that lie far from its box out of a
 * scene: false matches along the outline, with the depth of what is behind. */
void dropStrays(const FrontResult& front, LoadedCloud& scene);

/** \brief Tells the model half what the images gave. The best mode looks at the whole
 * scene through the outline, the paper's chain at the object's points in their box. */
void handOver(const FrontResult& front, bool whole_scene, ModelOptions& model);

/** \brief Refuses a model that leaves doubt where nobody pointed at the object: what
 * was taken for one may be none. */
void requireNoDoubt(const ModelResult& result);

/** \brief Refuses what fills but a piece of the box that was drawn around the object,
 * where no outline tells them apart. */
void requireBoxFilled(const FrontResult& front, const ModelResult& result);

} // namespace pcl_sq::app
