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

bool CameraIntrinsics::isValid(std::string* why) const {
  if (!std::isfinite(fx + fy + cx + cy))
    return fail(why, "a number of the camera is not finite");
  if (fx <= 0.0 || fy <= 0.0)
    return fail(why, "the focal length must be positive");
  if (width < 0 || height < 0)
    return fail(why, "the image size must not be negative");
  // An off-centre crop is fine; a principal point far outside is another image's.
  const bool known = width > 0 && height > 0;
  if (known && (cx < -0.5 * width || cx > 1.5 * width || cy < -0.5 * height ||
                cy > 1.5 * height))
    return fail(why,
                "the principal point (" + std::to_string(cx) + ", " +
                    std::to_string(cy) + ") lies far outside of an image of " +
                    std::to_string(width) + " x " + std::to_string(height) + " px");
  return true;
}

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
