// SPDX-License-Identifier: BSD-3-Clause
// Whether a cloud without a known viewpoint is in its camera's frame, as those of
// stereo and depth cameras mostly are. PCD files then say VIEWPOINT 0 0 0, which they
// also say when nobody cared.
#include "observe_parts.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr double NEAREST = 2.0; ///< camera to points, in half diagonals of their box
constexpr double FRONT = 0.7;   ///< least cosine between z and the points
constexpr double POINTS_A_CELL = 8.0; ///< of the angular grid
constexpr double GAP = 0.2;           ///< between two layers, in half diagonals
constexpr double DOUBLE_CELLS = 0.2;  ///< more cells with two layers make no view

} // namespace

bool isCameraFrame(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d middle =
      0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
  const double extent = (points.rowwise().maxCoeff() - middle).norm();
  const double distance = middle.norm();
  if (!(extent > 0.0) || distance < NEAREST * extent || middle.z() < FRONT * distance)
    return false;
  const PinholeCamera camera =
      PinholeCamera::lookingAt(Eigen::Vector3d::Zero(), middle, 1.0);
  Eigen::Matrix2Xd image(2, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    image.col(i) = camera.project(points.col(i));
  const Eigen::Vector2d low = image.rowwise().minCoeff();
  const Eigen::Vector2d size = image.rowwise().maxCoeff() - low;
  const int cells = std::max(
      1,
      static_cast<int>(std::sqrt(static_cast<double>(points.cols()) / POINTS_A_CELL)));
  std::vector<std::vector<double>> ranges(static_cast<std::size_t>(cells * cells));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    int cell[2];
    for (int k = 0; k < 2; ++k)
      cell[k] = std::min(
          cells - 1,
          static_cast<int>(cells * (image(k, i) - low[k]) / std::max(size[k], 1e-12)));
    ranges[static_cast<std::size_t>(cell[0] + cells * cell[1])].push_back(
        points.col(i).norm());
  }
  int filled = 0, layered = 0;
  for (std::vector<double>& cell : ranges) {
    if (cell.size() < 4)
      continue;
    ++filled;
    std::sort(cell.begin(), cell.end());
    // a layer is more than a stray point
    for (std::size_t i = 2; i + 1 < cell.size(); ++i)
      if (cell[i] - cell[i - 1] > GAP * extent) {
        ++layered;
        break;
      }
  }
  return filled > 0 && layered <= DOUBLE_CELLS * filled;
}

} // namespace pcl_sq::detail
