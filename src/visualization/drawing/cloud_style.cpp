// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/cloud_style.h"

#include "visualization/drawing/ink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace pcl_sq {
namespace {

constexpr Color NEUTRAL = {72, 84, 104}; ///< grey-blue of clouds without colours
/// Up to SKIN object sizes from the object points keep their colour, from PALE on they
/// have lost the share FADED of it.
constexpr double SKIN = 0.03, PALE = 0.15, FADED = 0.75;
constexpr double FARTHEST = 1e4; ///< more diagonals than this show nothing

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
  // in its own camera's view a cloud is a square grid, covered from sqrt(2) on
  const double cover = camera.perspective() ? 1.5 : 1.1;
  return std::clamp(
      cover * spacing, std::max(1.5 * unit, 1.0), std::max(5.0 * unit, 1.5));
}

/** \brief Distance of a point from the object: from the model's surface, or from the
 * frame's box if there is no model; zero inside [m]. */
double distanceFrom(const SnapshotScene& scene,
                    const Eigen::AlignedBox3d& box,
                    const Eigen::Vector3d& point) {
  if (scene.model.empty())
    return box.exteriorDistance(point);
  double least = std::numeric_limits<double>::infinity();
  for (const Superquadric& part : scene.model.parts)
    least = std::min(least, part.radialDistance(point));
  return std::max(0.0, least);
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
      if (box.exteriorDistance(p) > reach || (camera.perspective() && !(p.z() > 0.0)))
        continue;
      Color color = inkOn(scene.options.background, NEUTRAL);
      if (cloud.colors.cols() > 0)
        color = {cloud.colors(0, i), cloud.colors(1, i), cloud.colors(2, i)};
      const double distance = distanceFrom(scene, box, p) / size;
      if (distance <= SKIN)
        object.push_back(p);
      color = mix(color,
                  scene.options.background,
                  FADED * std::clamp((distance - SKIN) / (PALE - SKIN), 0.0, 1.0));
      styled.points.push_back(p);
      styled.colors.push_back(color);
    }
  styled.size = scene.options.point_size;
  if (styled.size == 0.0)
    styled.size = sizeFromDensity(object.empty() ? styled.points : object, camera);
  return styled;
}

} // namespace pcl_sq
