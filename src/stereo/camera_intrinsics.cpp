// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/camera_intrinsics.h"

#include "util/option_check.h"

#include <cmath>

namespace pcl_sq {

bool StereoIntrinsics::isValid(std::string* why) const {
  if (!CameraIntrinsics::isValid(why))
    return false;
  detail::OptionCheck check(why);
  check.require(std::isfinite(baseline) && std::isfinite(doffs),
                "the baseline or doffs is not finite");
  check.require(baseline != 0.0,
                "the baseline is zero, so disparity says nothing about depth");
  check.require(baseline >= 0.0,
                "the second camera is left of the first: exchange the two");
  const std::string implausible = "the baseline of " + std::to_string(baseline) +
                                  " m is not plausible: give the file's unit of length";
  check.require(baseline >= SMALLEST_BASELINE && baseline <= LARGEST_BASELINE,
                implausible.c_str());
  return check.passed();
}

} // namespace pcl_sq
