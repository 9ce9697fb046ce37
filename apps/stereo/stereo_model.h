// SPDX-License-Identifier: BSD-3-Clause
// From what the images gave to the model, the same for the program and for Python.
#pragma once

#include "options/model_options.h"
#include "stereo/stereo_front.h"

namespace pcl_sq::app {

/** \brief A model from images with the clouds that it was made of. */
struct StereoModel {
  ModelResult result;
  LoadedCloud object; ///< only the object's points are finite
  LoadedCloud scene;  ///< all points
};

/** \brief Matcher and refinement where the user names none: semi-global and refined in
 * the best mode. */
void chooseMatcher(const ModelOptions& model, FrontOptions& front);

/** \brief From the images to the cloud of all things; the model's options are told the
 * camera and its noise. \throw Failure */
StereoView readSceneViews(FrontOptions& front, ModelOptions& model);

/** \brief The model half. The best mode looks at the whole scene through the outline,
 * the paper's chain at the object's points in their box.
 * \throw Failure if there is no model */
StereoModel makeStereoModel(const FrontOptions& options,
                            const StereoView& front,
                            ModelOptions model);

} // namespace pcl_sq::app
