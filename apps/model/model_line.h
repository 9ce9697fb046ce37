// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/model_options.h"

#include <string>

namespace pcl_sq::app {

/** \brief A cloud's model as one line of JSON; where there is none, a line with its
 * "input" and the "error". */
struct ModelLine {
  std::string line;
  std::string failure;            ///< a sentence, or "" where there is a model
  std::vector<std::string> notes; ///< of the report: fall-backs
};

/** \brief Reads a cloud and makes its line; never throws for what the file holds. */
ModelLine makeModelLine(const std::string& path, const ModelOptions& options);

} // namespace pcl_sq::app
