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
constexpr double FAR_AWAY =
    6.0; ///< viewpoint that is guessed to points, in half diagonals
constexpr int DIRECTIONS = 100;           ///< from which the points are looked at
constexpr Eigen::Index SOME_POINTS = 600; ///< points
/** \brief Share of the directions from which points of one view look seen once: those
 * near the camera's. Of a plate's two sides nobody knows which. */
constexpr double LEAST_SHARE = 0.03, MOST_SHARE = 0.4;
/** \brief Least growth of the range from the middle of the view to its rim, in half
 * diagonals: bodies bulge towards who sees them. */
constexpr double BULGE = 0.02;
constexpr double POINTS_AN_ANGLE = 8.0; ///< of the angular grid
constexpr double GAP = 0.2;             ///< between two layers, in half diagonals
constexpr double DOUBLE_CELLS = 0.2;    ///< more cells with two layers make no view
/** \brief Largest median scatter about the cells' planes, in half diagonals: noise and
 * curvature stay below, front and back of a rod do not. */
constexpr double SCATTER = 0.03;
constexpr double MUCH = 2.0; ///< more of either than a view from nearby has
/** \brief Determinant over the trace's square of points on a line, by rounding. */
constexpr double SLIVER = 1e-12;

/** \brief A point as it is seen: its image and how far it is. */
struct SeenPoint {
  double x, y, range;
};

/** \brief Standard deviation of ranges about their plane over the image. */
double scatter(const SeenPoint* cell, std::size_t count) {
  const double n = double(count);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
    mean += Eigen::Vector3d(cell[i].x, cell[i].y, cell[i].range) / n;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d d =
        Eigen::Vector3d(cell[i].x, cell[i].y, cell[i].range) - mean;
    moments += d * d.transpose();
  }
  // what the plane leaves of the ranges' moment
  const Eigen::Matrix2d image = moments.topLeftCorner<2, 2>();
  const Eigen::Vector2d slope = moments.topRightCorner<2, 1>();
  const double flat = image.determinant(), size = image.trace();
  double left = moments(2, 2);
  if (flat > SLIVER * size * size)
    left -= slope.dot(image.inverse() * slope);
  else if (size > 0.0)
    left -= slope.squaredNorm() / size;
  return std::sqrt(std::max(0.0, left) / (n - 3.0));
}

/** \brief What points look like from a place. */
struct Look {
  /** \brief How much more than in a view rays meet two layers of them: up to 1 hardly
   * any does. MUCH or more: not known any better. */
  double doubt = MUCH;
  double bulge = 0.0; ///< range at the rim of the view over that in its middle [m]

  bool once() const { return doubt <= 1.0; }
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
  const int cells =
      std::max(1,
               static_cast<int>(
                   std::sqrt(static_cast<double>(points.cols()) / POINTS_AN_ANGLE)));
  const auto cell_count = std::size_t(cells) * std::size_t(cells);
  std::vector<std::size_t> cell_of(std::size_t(points.cols())), begins(cell_count + 1);
  double inner = 0.0, outer = 0.0;
  int inner_count = 0, outer_count = 0;
  std::vector<double> ranges(std::size_t(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    int cell[2];
    double radius = 0.0;
    for (int k = 0; k < 2; ++k) {
      const double at = (image(k, i) - low[k]) / std::max(size[k], 1e-12);
      cell[k] = std::min(cells - 1, static_cast<int>(cells * at));
      radius += std::pow(2.0 * at - 1.0, 2);
    }
    const double range = (points.col(i) - place).norm();
    ranges[std::size_t(i)] = range;
    cell_of[std::size_t(i)] =
        std::size_t(cell[0]) + std::size_t(cells) * std::size_t(cell[1]);
    ++begins[cell_of[std::size_t(i)] + 1];
    (radius < 0.4 ? inner : outer) += range;
    ++(radius < 0.4 ? inner_count : outer_count);
  }
  look.bulge = outer / std::max(1, outer_count) - inner / std::max(1, inner_count);
  for (std::size_t c = 0; c < cell_count; ++c)
    begins[c + 1] += begins[c];
  std::vector<SeenPoint> seen(ranges.size());
  std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
  for (std::size_t i = 0; i < ranges.size(); ++i)
    seen[next[cell_of[i]]++] = {
        image(0, Eigen::Index(i)), image(1, Eigen::Index(i)), ranges[i]};
  const auto isFilled = [&](std::size_t c) { return begins[c + 1] - begins[c] >= 4; };
  std::size_t layered = 0, filled = 0;
  for (std::size_t c = 0; c < cell_count; ++c)
    filled += isFilled(c);
  const double allowed = DOUBLE_CELLS * double(filled); // with two layers
  for (std::size_t c = 0; c < cell_count; ++c) {
    if (!isFilled(c))
      continue;
    const std::size_t begin = begins[c], end = begins[c + 1];
    std::sort(seen.begin() + std::ptrdiff_t(begin),
              seen.begin() + std::ptrdiff_t(end),
              [](const SeenPoint& a, const SeenPoint& b) { return a.range < b.range; });
    // a layer is more than a stray point
    for (std::size_t i = begin + 2; i + 1 < end; ++i)
      if (seen[i].range - seen[i - 1].range > GAP * extent) {
        ++layered;
        break;
      }
    if (double(layered) >= MUCH * allowed)
      return look;
  }
  if (filled == 0)
    return look;
  std::vector<double> scatters;
  for (std::size_t c = 0; c < cell_count; ++c)
    if (isFilled(c))
      scatters.push_back(scatter(&seen[begins[c]], begins[c + 1] - begins[c]));
  const auto middle_one = scatters.begin() + std::ptrdiff_t(scatters.size() / 2);
  std::nth_element(scatters.begin(), middle_one, scatters.end());
  look.doubt = std::max(double(layered) / allowed, *middle_one / (SCATTER * extent));
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
  return lookFrom(Eigen::Vector3d::Zero(), points).once();
}

std::optional<Eigen::Vector3d>
guessViewpoint(const Eigen::Matrix3Xd& all,
               bool one_sided,
               const std::function<std::optional<Eigen::Vector3d>()>& likely) {
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
  const auto some = points.leftCols(std::min(points.cols(), SOME_POINTS));
  bool asked = !likely;
  const auto likelyPlace = [&]() -> std::optional<Eigen::Vector3d> {
    asked = true;
    const std::optional<Eigen::Vector3d> direction = likely();
    if (!direction)
      return std::nullopt;
    const Eigen::Vector3d place = middle + FAR_AWAY * extent * *direction;
    return lookFrom(place, points).once() ? std::optional(place) : std::nullopt;
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), roundest = Eigen::Vector3d::Zero();
  double most_bulge = -1e300;
  int passed = 0;
  for (int i = 0; i < DIRECTIONS; ++i) {
    // Fibonacci's spiral: about equally many everywhere on the sphere
    const double z = 1.0 - (2.0 * i + 1.0) / DIRECTIONS;
    const double turn = i * 2.399963229728653; // the golden angle
    const double r = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
    const Look look = lookFrom(middle + FAR_AWAY * extent * direction, some);
    // from between two of these directions points look about as from the nearer one
    if (!asked && (one_sided || look.doubt < MUCH))
      if (std::optional<Eigen::Vector3d> place = likelyPlace())
        return place;
    if (look.once() && look.bulge > BULGE * extent) {
      sum += direction;
      ++passed;
    }
    if (look.bulge > most_bulge) {
      most_bulge = look.bulge;
      roundest = direction;
    }
  }
  if (one_sided)
    return middle +
           FAR_AWAY * extent * (sum.norm() > 1e-6 ? sum.normalized() : roundest);
  if (passed < LEAST_SHARE * DIRECTIONS || passed > MOST_SHARE * DIRECTIONS ||
      !(sum.norm() > 1e-6))
    return std::nullopt;
  const Eigen::Vector3d place = middle + FAR_AWAY * extent * sum.normalized();
  return lookFrom(place, points).once() ? std::optional(place) : std::nullopt;
}

} // namespace pcl_sq::detail
