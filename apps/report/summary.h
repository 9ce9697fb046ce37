// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/model_options.h"

#include <string>

namespace pcl_sq::app {

/** \brief How large an object is [m]. */
struct ObjectSize {
  /** \brief Width, depth and height: of the smallest upright box, the height above the
   * table where there is one. Without an upward direction the longest side first. */
  Eigen::Vector3d sides;
  bool upright = false;  ///< whether the third side is the height
  bool on_table = false; ///< whether it is the height above the table
};

ObjectSize sizeOf(const ModelResult& result);

/** \brief The result for people, on stdout. */
void printSummary(const ModelResult& result);

/** \brief The fall-backs that the estimation took, on stderr.
 * \param[in] cloud whose they are, where there are several */
void printNotes(const ModelResult& result, const std::string& cloud = {});

/** \brief A stage of the work in plain words: "fitting". */
std::string wordsFor(const std::string& stage);

} // namespace pcl_sq::app
