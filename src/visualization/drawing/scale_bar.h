// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_sq {

/** \brief Length of a scale bar and its text. */
struct ScaleBar {
  double length = 0.0; ///< [m]
  std::string label;   ///< e.g. "5 cm"
};

/** \brief The longest of 1, 2 and 5 times a power of ten that is at most \a longest
 * [m]. \pre longest is positive and finite */
ScaleBar roundScaleBar(double longest);

} // namespace pcl_sq
