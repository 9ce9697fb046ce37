// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/camera_intrinsics.h"

#include <cmath>

namespace pcl_sq {
namespace {

bool fail(std::string* why, const std::string& reason) {
  if (why != nullptr)
    *why = reason;
  return false;
}

} // namespace

bool StereoIntrinsics::isValid(std::string* why) const {
  if (!CameraIntrinsics::isValid(why))
    return false;
  if (!std::isfinite(baseline) || !std::isfinite(doffs))
    return fail(why, "the baseline or doffs is not finite");
  if (baseline == 0.0)
    return fail(why, "the baseline is zero, so disparity says nothing about depth");
  if (baseline < 0.0)
    return fail(why, "the second camera is left of the first: exchange the two");
  if (baseline < 1e-3 || baseline > 10.0)
    return fail(why,
                "the baseline of " + std::to_string(baseline) +
                    " m is not plausible: give the file's unit of length");
  return true;
}

} // namespace pcl_sq
