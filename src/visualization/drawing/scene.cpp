// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/scene.h"

#include "visualization/display/display_surface.h"

#include <algorithm>
#include <vector>

namespace pcl_sq {
namespace {

/// Points are close to the object up to this share of its box's diagonal.
constexpr double CLOSE = 0.06;
/// Share of a cloud's points left out at each end of each axis: stray measurements.
constexpr double STRAY = 0.002;

using Points = std::vector<Eigen::Vector3d>;

Eigen::Matrix3Xd toMatrix(const Points& points) {
  if (points.empty())
    return Eigen::Matrix3Xd(3, 0);
  return Eigen::Map<const Eigen::Matrix3Xd>(
      points.front().data(), 3, static_cast<Eigen::Index>(points.size()));
}

void append(const Eigen::Matrix3Xd& columns, Points& points) {
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    points.push_back(columns.col(i));
}

/** \brief Box of the points between two quantiles of each axis. */
Eigen::AlignedBox3d trimmedBox(const Points& points) {
  Eigen::AlignedBox3d box;
  std::vector<double> values(points.size());
  const auto cut =
      static_cast<std::ptrdiff_t>(STRAY * static_cast<double>(points.size()));
  Eigen::Vector3d low, high;
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [axis](const auto& p) {
      return p[axis];
    });
    std::nth_element(values.begin(), values.begin() + cut, values.end());
    low[axis] = values[cut];
    std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
    high[axis] = values[values.size() - 1 - cut];
  }
  return {low, high};
}

} // namespace

Eigen::Matrix3Xd SnapshotScene::focus() const {
  Points points;
  for (const Superquadric& part : model.parts) {
    const DisplaySurface surface = displaySurface(part, 8);
    points.insert(points.end(), surface.vertices.begin(), surface.vertices.end());
  }
  for (const Surface& surface : surfaces)
    points.insert(
        points.end(), surface.mesh.vertices.begin(), surface.mesh.vertices.end());
  for (const Segments& s : segments)
    append(s.ends, points);
  for (const Markers& m : markers)
    append(m.points, points);

  if (points.empty()) {
    for (const Cloud& cloud : clouds)
      append(cloud.points, points);
    if (points.empty())
      return toMatrix(points);
    const Eigen::AlignedBox3d box = trimmedBox(points);
    points.erase(std::remove_if(points.begin(),
                                points.end(),
                                [&](const auto& p) { return !box.contains(p); }),
                 points.end());
    return toMatrix(points);
  }

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points)
    box.extend(p);
  const double close = CLOSE * box.sizes().norm();
  const Eigen::AlignedBox3d around(box.min().array() - close,
                                   box.max().array() + close);
  for (const Cloud& cloud : clouds)
    for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
      const Eigen::Vector3d p = cloud.points.col(i);
      if (!around.contains(p))
        continue;
      for (const Superquadric& part : model.parts)
        if (part.radialDistance(p) < close) {
          points.push_back(p);
          break;
        }
    }
  return toMatrix(points);
}

} // namespace pcl_sq
