// SPDX-License-Identifier: BSD-3-Clause
// All things of a scene in one picture.
#pragma once

#include "files/cloud_io.h"
#include "model/scene_model.h"

#include <opencv2/core/mat.hpp>

namespace pcl_sq::app {

/** \brief The things over their image, numbered, and in space beside it, BGR.
 * \param[in] input the organized cloud; its colours are the image */
cv::Mat drawScene(const LoadedCloud& input, const SceneResult& result);

/** \brief The number of the thing of each pixel, 0 for none; 16 bits where 8 are too
 * few. */
cv::Mat labelImage(const SceneResult& result);

/** \brief Labels of an image file: one channel of 8 or 16 bits, 0 for no thing.
 * \throw Failure */
LabelImage readLabels(const std::string& path);

} // namespace pcl_sq::app
