// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/snapshot_options.h"

namespace pcl_sq {

bool SnapshotOptions::isValid(std::string* why) const {
  const char* reason = nullptr;
  if (width < 16 || width > 4096 || height < 16 || height > 4096)
    reason = "the picture's sides must be 16 to 4096 pixels";
  else if (!up.allFinite() || !(up.norm() > 1e-6))
    reason = "the upward direction must be finite and not zero";
  else if (sensor && !sensor->allFinite())
    reason = "the sensor's place must be finite";
  else if (!(opacity >= 0.0 && opacity <= 1.0))
    reason = "the opacity must lie in [0, 1]";
  else if (!(context >= 0.0))
    reason = "the context must not be negative";
  else if (!(point_size >= 0.0 && point_size <= 100.0))
    reason = "the point size must lie in [0, 100] pixels";
  if (reason != nullptr && why != nullptr)
    *why = reason;
  return reason == nullptr;
}

} // namespace pcl_sq
