// SPDX-License-Identifier: BSD-3-Clause
// From where a cloud without a known viewpoint was seen. Those of stereo and depth
// cameras mostly are in their camera's frame; PCD files then say VIEWPOINT 0 0 0, which
// they also say when nobody cared.
#include "sensor/camera_pose.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr double NEAREST = 2.0; ///< camera to points, in half diagonals of their box
constexpr double FRONT = 0.7;   ///< least cosine between z and the points
constexpr double FAR = 6.0; ///< viewpoint that is guessed to points, in half diagonals
constexpr int DIRECTIONS = 100;         ///< from which the points are looked at
constexpr Eigen::Index LOOKED_AT = 600; ///< points
/** \brief Share of the directions from which points of one view look seen once: those
 * near the camera's. Of a plate's two sides nobody knows which. */
constexpr double FEWEST = 0.03, MOST = 0.4;
/** \brief Least growth of the range from the middle of the view to its rim, in half
 * diagonals: bodies bulge towards who sees them. */
constexpr double BULGE = 0.02;
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

/** \brief What points look like from a place. */
struct Look {
  bool once = false;  ///< hardly any ray meets two layers of them
  double bulge = 0.0; ///< range at the rim of the view over that in its middle [m]
};

Look lookFrom(const Eigen::Vector3d& place,
              const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  Look look;
  const Eigen::Vector3d middle =
      0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
  const double extent = (points.rowwise().maxCoeff() - middle).norm();
  const PinholeCamera camera = PinholeCamera::lookingAt(place, middle, 1.0);
  Eigen::Matrix2Xd image(2, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    image.col(i) = camera.project(points.col(i));
  const Eigen::Vector2d low = image.rowwise().minCoeff();
  const Eigen::Vector2d size = image.rowwise().maxCoeff() - low;
  const int cells = std::max(
      1,
      static_cast<int>(std::sqrt(static_cast<double>(points.cols()) / POINTS_A_CELL)));
  std::vector<std::vector<Eigen::Vector3d>> pixels(static_cast<std::size_t>(cells) *
                                                   static_cast<std::size_t>(cells));
  double inner = 0.0, outer = 0.0;
  int inner_count = 0, outer_count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    int cell[2];
    double radius = 0.0;
    for (int k = 0; k < 2; ++k) {
      const double at = (image(k, i) - low[k]) / std::max(size[k], 1e-12);
      cell[k] = std::min(cells - 1, static_cast<int>(cells * at));
      radius += std::pow(2.0 * at - 1.0, 2);
    }
    const double range = (points.col(i) - place).norm();
    const int at = cell[0] + cells * cell[1];
    pixels[static_cast<std::size_t>(at)].emplace_back(image(0, i), image(1, i), range);
    (radius < 0.4 ? inner : outer) += range;
    ++(radius < 0.4 ? inner_count : outer_count);
  }
  look.bulge = outer / std::max(1, outer_count) - inner / std::max(1, inner_count);
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
    return look;
  const auto middle_one = scatters.begin() + std::ptrdiff_t(scatters.size() / 2);
  std::nth_element(scatters.begin(), middle_one, scatters.end());
  look.once = *middle_one <= SCATTER * extent;
  return look;
}

} // namespace

bool isCameraFrame(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d middle =
      0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
  const double extent = (points.rowwise().maxCoeff() - middle).norm();
  const double distance = middle.norm();
  if (!(extent > 0.0) || distance < NEAREST * extent || middle.z() < FRONT * distance)
    return false;
  return lookFrom(Eigen::Vector3d::Zero(), points).once;
}

std::optional<Eigen::Vector3d>
guessViewpoint(const Eigen::Matrix3Xd& all,
               bool one_sided,
               const std::optional<Eigen::Vector3d>& likely) {
  // a few strays would put the middle anywhere
  const Eigen::Index n = all.cols(), cut = n / 50;
  Eigen::Vector3d low, high;
  std::vector<double> along(static_cast<std::size_t>(n));
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd::Map(along.data(), n) = all.row(k);
    std::sort(along.begin(), along.end());
    low[k] = along[std::size_t(cut)];
    high[k] = along[std::size_t(n - 1 - cut)];
  }
  const Eigen::Vector3d middle = 0.5 * (low + high);
  const double extent = (high - middle).norm();
  if (!(extent > 0.0))
    return std::nullopt;
  Eigen::Matrix3Xd points(3, n);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if ((all.col(i) - middle).norm() < 2.0 * extent)
      points.col(kept++) = all.col(i);
  points.conservativeResize(3, kept);
  const auto some = points.leftCols(std::min(points.cols(), LOOKED_AT));
  if (likely) {
    const Eigen::Vector3d place = middle + FAR * extent * *likely;
    if (lookFrom(place, points).once)
      return place;
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), roundest = Eigen::Vector3d::Zero();
  double most_bulge = -1e300;
  int passed = 0;
  for (int i = 0; i < DIRECTIONS; ++i) {
    // Fibonacci's spiral: about equally many everywhere on the sphere
    const double z = 1.0 - (2.0 * i + 1.0) / DIRECTIONS;
    const double turn = i * 2.399963229728653; // the golden angle
    const double r = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
    const Look look = lookFrom(middle + FAR * extent * direction, some);
    if (look.once && look.bulge > BULGE * extent) {
      sum += direction;
      ++passed;
    }
    if (look.bulge > most_bulge) {
      most_bulge = look.bulge;
      roundest = direction;
    }
  }
  if (one_sided)
    return middle + FAR * extent * (sum.norm() > 1e-6 ? sum.normalized() : roundest);
  if (passed < FEWEST * DIRECTIONS || passed > MOST * DIRECTIONS ||
      !(sum.norm() > 1e-6))
    return std::nullopt;
  const Eigen::Vector3d place = middle + FAR * extent * sum.normalized();
  return lookFrom(place, points).once ? std::optional(place) : std::nullopt;
}

} // namespace pcl_sq::detail
