// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_options.h"

#include <cmath>

namespace pcl_sq {

int StereoOptions::blockSizeFor(int width) const {
  if (block_size != 0)
    return block_size;
  if (matcher == StereoMatcher::SGBM)
    return 5;
  return width < 600 ? 11 : 15; // small images have small objects
}

bool StereoOptions::isValid(std::string* why) const {
  const auto require = [why](bool holds, const char* reason) {
    if (!holds && why != nullptr)
      *why = reason;
    return holds;
  };
  return require(block_size == 0 ||
                     (block_size >= 3 && block_size <= 51 && block_size % 2 == 1),
                 "block_size must be odd and 3 to 51, or 0") &&
         require(min_depth == 0.0 || (min_depth >= 1e-3 && min_depth <= 1e6),
                 "min_depth must lie in [0.001, 1e6] m, or be 0") &&
         require(max_depth == 0.0 || (max_depth >= 1e-3 && max_depth <= 1e6),
                 "max_depth must lie in [0.001, 1e6] m, or be 0") &&
         require(min_depth == 0.0 || max_depth == 0.0 || min_depth < max_depth,
                 "min_depth must be less than max_depth") &&
         require(left_right_tolerance <= 100, "left_right_tolerance must be <= 100") &&
         require(uniqueness >= 0 && uniqueness <= 100,
                 "uniqueness must lie in [0, 100]") &&
         require(texture_threshold >= 0 && texture_threshold <= 100000,
                 "texture_threshold must lie in [0, 100000]") &&
         require(speckle_window >= 0 && speckle_window <= 100000,
                 "speckle_window must lie in [0, 100000]") &&
         require(speckle_range >= 1 && speckle_range <= 100,
                 "speckle_range must lie in [1, 100]") &&
         require(wls_lambda >= 0.0 && wls_lambda <= 1e6,
                 "wls_lambda must lie in [0, 1e6]") &&
         require(wls_sigma >= 0.1 && wls_sigma <= 10.0,
                 "wls_sigma must lie in [0.1, 10]") &&
         require(wls_confidence >= 0.0 && wls_confidence <= 255.0,
                 "wls_confidence must lie in [0, 255]");
}

} // namespace pcl_sq
