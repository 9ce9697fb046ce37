// SPDX-License-Identifier: BSD-3-Clause
// Private. Whether two sets of points are one body's surface or two bodies'.
#pragma once

#include "patches/scene_view.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief How well one body explains a set of pixels. */
struct BodyScore {
  double squares = 0.0; ///< sum of the points' squared distances [m^2]
  double count = 0.0;   ///< of independent points
  double noise = 0.0;   ///< standard deviation of a point [m]
  int parameters = 0;   ///< of the family
  bool fits = false;    ///< false: the points are too few
  bool is_vessel = false;
};

/** \brief Fits the best family to a set of pixels, by points alone. */
[[nodiscard]] BodyScore scoreOfBody(const SceneView& view,
                                    const std::vector<int>& pixels);

/** \brief By how much one body explains two sets of pixels better than a body for each:
 * the difference of the scores of M17, positive for one body. */
[[nodiscard]] double
gainOfOneBody(const BodyScore& first, const BodyScore& second, const BodyScore& both);

} // namespace pcl_sq::detail
