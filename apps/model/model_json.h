// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/model_options.h"

namespace pcl_sq::app {

/** \brief The options that shaped a model, for its file. */
std::string optionsToJson(const ModelOptions& options);

/** \brief What the estimation saw and did, for the model file. */
std::string reportToJson(const ModelResult& result);

} // namespace pcl_sq::app
