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
/** \brief Largest median scatter about the cells' planes, in half diagonals: noise and
 * curvature stay below, front and back of a rod do not. */
constexpr double SCATTER = 0.03;

/** \brief Standard deviation of ranges about their plane over the image. */
double scatter(const std::vector<Eigen::Vector3d>& cell) {
  Eigen::MatrixX3d plane(Eigen::Index(cell.size()), 3);
  Eigen::VectorXd range(Eigen::Index(cell.size()));
  for (std::size_t i = 0; i < cell.size(); ++i) {
    plane.row(Eigen::Index(i)) << cell[i].x() - cell[0].x(), cell[i].y() - cell[0].y(),
        1.0;
    range[Eigen::Index(i)] = cell[i].z();
  }
  const Eigen::VectorXd residuals =
      range - plane * plane.colPivHouseholderQr().solve(range);
  return residuals.norm() / std::sqrt(double(cell.size() - 3));
}

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
  std::vector<std::vector<Eigen::Vector3d>> pixels(
      static_cast<std::size_t>(cells * cells));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    int cell[2];
    for (int k = 0; k < 2; ++k)
      cell[k] = std::min(
          cells - 1,
          static_cast<int>(cells * (image(k, i) - low[k]) / std::max(size[k], 1e-12)));
    pixels[static_cast<std::size_t>(cell[0] + cells * cell[1])].emplace_back(
        image(0, i), image(1, i), points.col(i).norm());
  }
  std::size_t layered = 0;
  std::vector<double> scatters;
  for (std::vector<Eigen::Vector3d>& cell : pixels) {
    if (cell.size() < 4)
      continue;
    scatters.push_back(scatter(cell));
    std::sort(cell.begin(), cell.end(), [](const auto& a, const auto& b) {
      return a.z() < b.z();
    });
    // a layer is more than a stray point
    for (std::size_t i = 2; i + 1 < cell.size(); ++i)
      if (cell[i].z() - cell[i - 1].z() > GAP * extent) {
        ++layered;
        break;
      }
  }
  if (scatters.empty() || double(layered) > DOUBLE_CELLS * double(scatters.size()))
    return false;
  const auto middle_one = scatters.begin() + std::ptrdiff_t(scatters.size() / 2);
  std::nth_element(scatters.begin(), middle_one, scatters.end());
  return *middle_one <= SCATTER * extent;
}

} // namespace pcl_sq::detail
