// SPDX-License-Identifier: BSD-3-Clause
#include "input/sample_surface.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pcl_sq::app {

std::vector<Eigen::Vector3d> sampleSurface(const Shape& shape, std::size_t count) {
  const auto corner = [&shape](std::size_t triangle, std::size_t k) {
    return shape.points[shape.triangles[triangle][k]];
  };
  std::vector<double> area_until(shape.triangles.size());
  double area = 0.0;
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    const Eigen::Vector3d a = corner(t, 0);
    const double twice = (corner(t, 1) - a).cross(corner(t, 2) - a).norm();
    area += std::isfinite(twice) ? 0.5 * twice : 0.0;
    area_until[t] = area;
  }
  std::vector<Eigen::Vector3d> points;
  if (!(area > 0.0) || !std::isfinite(area))
    return points;
  std::mt19937 random; // its numbers are those of the standard, unlike distributions'
  const auto uniform = [&random] { return (random() + 0.5) / 4294967296.0; };
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    // one in each of equal shares of the area: more even than anywhere at random
    const double at =
        area * (static_cast<double>(i) + uniform()) / static_cast<double>(count);
    const auto it = std::upper_bound(area_until.begin(), area_until.end(), at);
    const auto t = std::min(static_cast<std::size_t>(it - area_until.begin()),
                            area_until.size() - 1);
    const double u = std::sqrt(uniform()), v = uniform();
    points.push_back((1.0 - u) * corner(t, 0) + u * (1.0 - v) * corner(t, 1) +
                     u * v * corner(t, 2));
  }
  return points;
}

} // namespace pcl_sq::app
