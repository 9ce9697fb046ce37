// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_options.h"

#include "pcl_sq/superquadric.h"
#include "util/option_check.h"

namespace pcl_sq {

bool PaperFitOptions::isValid(std::string* why) const {
  detail::OptionCheck check(why);
  check.inRange("quantile", quantile, 0.0, 0.25);
  check.inRange("min_epsilon", min_epsilon, Superquadric::MIN_EPSILON, 1.0);
  check.inRange("max_epsilon", max_epsilon, 1.0, Superquadric::MAX_EPSILON);
  check.inRange("min_depth_ratio", min_depth_ratio, 1e-6, 1.0);
  check.inRange("max_depth_ratio", max_depth_ratio, 1.0, 10.0);
  check.inRange("max_iterations", max_iterations, 1, 1000);
  return check.passed();
}

bool FitOptions::isValid(std::string* why) const {
  detail::OptionCheck check(why);
  check.inRange("min_epsilon", min_epsilon, Superquadric::MIN_EPSILON, 1.0);
  check.inRange("max_epsilon", max_epsilon, 1.0, Superquadric::MAX_EPSILON);
  check.inRange("max_outlier_share", max_outlier_share, 0.0, 0.9);
  check.inRange("noise", noise, 0.0, 1e9);
  check.inRange("fixed", fixed, 0U, 0x7ffU);
  check.inRange("max_iterations", max_iterations, 1, 1000);
  return check.passed();
}

} // namespace pcl_sq
