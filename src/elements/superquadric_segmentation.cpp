// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/superquadric_segmentation.h"

#include "solver/surface_area.h"

#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>

namespace pcl_sq {

std::size_t detail::supportOf(const Superquadric& body,
                              std::size_t count,
                              double threshold,
                              double volume) {
  const double thickness = 2.0 * threshold;
  const double area =
      std::exp(logArea(body.semi_axes, body.epsilon1, body.epsilon2).value);
  const double smallest = std::log(volume / std::pow(thickness, 3));
  const double evidence = std::log(volume / (thickness * area));
  if (!(smallest > 0.0))
    return count;
  return static_cast<std::size_t>(std::clamp(evidence / smallest, 0.0, 1.0) *
                                  static_cast<double>(count));
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(template class, SuperquadricSegmentation)
