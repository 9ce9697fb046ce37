// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/model_options.h"
#include "stereo/stereo_front.h"

namespace pcl_sq::app {

/** \brief The files that a pattern of the shell (*, ?, [...]) names, numbers in their
 * order: 2 before 10. \throw Failure if there is none */
std::vector<std::string> filesOf(const std::string& pattern);

/** \brief One JSON line per frame, on standard output or in the model's output; what
 * fails has an "error" instead of a model.
 * \param[in] front its images are patterns \return DONE, or FAILED if a frame has no
 * model \throw Failure if the patterns name no frames */
int runSequence(FrontOptions front, const ModelOptions& model);

} // namespace pcl_sq::app
