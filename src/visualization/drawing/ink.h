// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/palette.h"

namespace pcl_sq {

/** \brief Whether dark lines are seen on that paper better than light ones. */
inline bool isLight(Color paper) {
  return 299 * paper.r + 587 * paper.g + 114 * paper.b > 128 * 1000;
}

/** \brief A colour for text: dark on light paper, light on dark paper. */
inline Color inkOn(Color paper, Color ink) {
  return isLight(paper) ? ink : mix(ink, {255, 255, 255}, 0.8);
}

/** \brief A colour for the outline of a coloured area on that paper. */
inline Color strongerOn(Color paper, Color area) {
  return isLight(paper) ? mix(area, {0, 0, 0}, 0.4) : mix(area, {255, 255, 255}, 0.4);
}

} // namespace pcl_sq
