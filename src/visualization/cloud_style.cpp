// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/cloud_style.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace pcl_sq {
namespace {

constexpr Color NEUTRAL = {72, 84, 104}; ///< grey-blue of clouds without colours
constexpr double FADED = 0.8;            ///< how much of its colour the farthest loses
constexpr double FARTHEST = 1e4;         ///< more diagonals than this show nothing

/** \brief Point size that covers the object without blots: a little more than the mean
 * distance of neighbours in the picture, from the area that the points occupy. */
double sizeFromDensity(const std::vector<Eigen::Vector3d>& object,
                       const ViewCamera& camera) {
  const double cell = std::max(camera.width(), camera.height()) / 80.0;
  std::unordered_set<long> occupied;
  for (const Eigen::Vector3d& p : object) {
    const Eigen::Vector3d pixel = camera.project(p) / cell;
    occupied.insert(std::lround(pixel.y()) * 100000 + std::lround(pixel.x()));
  }
  const double area = static_cast<double>(occupied.size()) * cell * cell;
  const double spacing = std::sqrt(area / static_cast<double>(object.size()));
  const double unit = std::min(camera.width(), camera.height()) / 960.0;
  return std::clamp(
      1.1 * spacing, std::max(1.5 * unit, 1.0), std::max(5.0 * unit, 1.5));
}

} // namespace

StyledPoints styleClouds(const SnapshotScene& scene,
                         const ViewCamera& camera,
                         const Eigen::AlignedBox3d& box) {
  const double size = std::max(box.sizes().norm(), 1e-12);
  const double reach = std::min(scene.options.context, FARTHEST) * size;
  StyledPoints styled;
  std::vector<Eigen::Vector3d> object;
  for (const auto& cloud : scene.clouds)
    for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
      const Eigen::Vector3d p = cloud.points.col(i);
      const double distance = box.exteriorDistance(p);
      if (distance > reach || (camera.perspective() && !(p.z() > 0.0)))
        continue;
      Color color = NEUTRAL;
      if (cloud.colors.cols() > 0)
        color = {cloud.colors(0, i), cloud.colors(1, i), cloud.colors(2, i)};
      // one percent of slack: the object's own skin must not look pale
      const double away = std::max(0.0, distance - 0.01 * size);
      if (away > 0.0) {
        const double t = std::sqrt(std::min(1.0, away / reach));
        color = mix(color, scene.options.background, FADED * t);
      } else {
        object.push_back(p);
      }
      styled.points.push_back(p);
      styled.colors.push_back(color);
    }
  styled.size = scene.options.point_size;
  if (styled.size == 0.0)
    styled.size = sizeFromDensity(object.empty() ? styled.points : object, camera);
  return styled;
}

} // namespace pcl_sq
