// SPDX-License-Identifier: BSD-3-Clause
// The point of a convex body that reaches farthest along the way to a point of it is
// at least as far away: repeating this climbs to a local maximum.
#include "quality/largest_radius.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr int MAX_CLIMBS = 100;
constexpr double CONVERGED = 1e-12; ///< relative gain of a step

double climb(const Superquadric& part,
             const Eigen::Vector3d& from,
             const Eigen::Vector3d& start) {
  double radius = 0.0;
  Eigen::Vector3d way = start;
  for (int step = 0; step < MAX_CLIMBS; ++step) {
    way = part.supportPoint(way) - from;
    const double next = way.norm();
    if (!(next > (1.0 + CONVERGED) * radius))
      return std::max(next, radius);
    radius = next;
  }
  return radius;
}

} // namespace

double largestRadius(const MultiSuperquadric& model, const Eigen::Vector3d& from) {
  double largest = 0.0;
  for (const Superquadric& part : model.parts)
    for (int i = 0; i < 27; ++i) { // axes, edges and corners of a cube
      const Eigen::Vector3d start =
          Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
      if (i != 13)
        largest = std::max(
            largest,
            climb(part, from, part.rotation * start.cwiseQuotient(part.semi_axes)));
    }
  return largest;
}

} // namespace pcl_sq::detail
