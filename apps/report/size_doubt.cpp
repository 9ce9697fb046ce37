// SPDX-License-Identifier: BSD-3-Clause
#include "report/size_doubt.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>

namespace pcl_sq::app {

std::string
sizeDoubt(const std::string& what, double size, const CloudOptions& options) {
  constexpr double SMALLEST = 1e-3, LARGEST = 10.0;
  if (size <= 0.0 || (size >= SMALLEST && size <= LARGEST))
    return {};
  char text[300];
  std::snprintf(
      text,
      sizeof(text),
      "%s would be %.3g m large if the file's unit is %s; give %s if it is another one",
      what.c_str(),
      size,
      options.unit.empty() ? "m" : options.unit.c_str(),
      options.unit_option.c_str());
  return text;
}

double sizeOf(const LoadedCloud& input) {
  Eigen::AlignedBox3f box;
  for (const auto& p : *input.cloud)
    if (!std::isnan(p.x))
      box.extend(p.getVector3fMap());
  return box.isEmpty() ? 0.0 : static_cast<double>(box.sizes().maxCoeff());
}

} // namespace pcl_sq::app
