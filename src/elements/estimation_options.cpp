// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/estimation_options.h"

#include "util/option_check.h"

namespace pcl_sq {

bool EstimationOptions::isValid(std::string* why) const {
  if (!voxels.isValid(why) || !prisms.isValid(why) || !paper_fit.isValid(why) ||
      !full_fit.isValid(why) || !view.isValid(why) || !object_fit.isValid(why))
    return false;
  detail::OptionCheck check(why);
  check.inRange("grasp_threshold", grasp_threshold, 1e-9, 1.0);
  return check.passed();
}

EstimationOptions EstimationOptions::paper() {
  EstimationOptions options;
  options.decomposition = Decomposition::PRISMS;
  options.fit = FitMode::PAPER;
  return options;
}

EstimationOptions EstimationOptions::best() {
  return {};
}

} // namespace pcl_sq
