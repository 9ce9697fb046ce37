// SPDX-License-Identifier: BSD-3-Clause
#include "parts/verdict.h"

#include "pieces/body_outline.h"
#include "tuning/parts_tuning.h"
#include "union/surface_statistics.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::verdict;

/** \brief Share of the points that the model explains, and how far off they are. */
void judgePoints(const MultiSuperquadric& model,
                 const ObservedObject& o,
                 double noise,
                 Verdict& verdict) {
  const Eigen::Index n = o.points.cols();
  if (n == 0)
    return;
  Eigen::Index explained = 0;
  std::vector<double> distances =
      smallestResiduals(model, o.points, kernels::Residual::FOOT_POINT);
  for (Eigen::Index i = 0; i < n; ++i) {
    double& distance = distances[std::size_t(i)];
    distance = std::abs(distance);
    const double own = o.noise.size() > 0 ? double(o.noise[i]) : noise;
    const double aside = o.sideways.size() > 0 ? double(o.sideways[i]) : 0.0;
    explained += distance <= SIGMAS * std::hypot(own, aside) + MODEL_ERROR * o.extent;
    distance = std::max(0.0, distance - own); // what the noise alone does not explain
  }
  verdict.points = double(explained) / double(n);
  const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const Eigen::Matrix3Xd spread = o.points.colwise() - o.points.rowwise().mean();
  verdict.off = *middle / (2.0 * std::sqrt(spread.squaredNorm() / double(n)));
}

std::vector<RayTest> rayTests(const MultiSuperquadric& model,
                              const Eigen::Vector3d& eye) {
  std::vector<RayTest> tests;
  for (const Superquadric& part : model.parts)
    tests.emplace_back(part, eye);
  return tests;
}

/** \brief Pixels between two of a coarse grid. */
double spacing(const std::vector<Eigen::Vector2d>& grid) {
  double step = 1e300;
  for (std::size_t i = 1; i < grid.size(); ++i)
    if (const double d = grid[i].x() - grid[i - 1].x(); d > 0.0)
      step = std::min(step, d);
  return step < 1e299 ? step : 1.0;
}

} // namespace

std::string Verdict::objection() const {
  if (points < EVEN || off > MOST_OFF)
    return "the object's points lie too far from any model of it: they are no one "
           "thing, or noise; give the object's region or mask, or more texture to a "
           "stereo pair";
  if (pixels < LEAST_PIXELS)
    return "the model covers but " + std::to_string(int(100.0 * pixels)) +
           " % of the object's pixels, so it is not the object; give a tighter region "
           "or a mask of the object";
  if (confidence() < EVEN)
    return "the model and what was seen agree by " +
           std::to_string(int(100.0 * confidence())) +
           " % only, so it is as likely wrong as right; give a tighter region or a "
           "mask of the object";
  return {};
}

double farthestOnSurface(const ObservedObject& observed, double noise) {
  double own = noise;
  if (observed.noise.size() > 0)
    own =
        std::sqrt(double(observed.noise.squaredNorm()) / double(observed.noise.size()));
  return SIGMAS * own + MODEL_ERROR * observed.extent;
}

Verdict
judge(const MultiSuperquadric& model, const ObservedObject& observed, double noise) {
  Verdict verdict;
  judgePoints(model, observed, noise, verdict);
  if (!observed.hasCamera() || observed.pixels.cells.empty())
    return verdict;
  const CellMask& mask = observed.pixels;
  const CellRect box = boundingRect(mask);
  const PinholeCamera& camera = observed.camera;
  const std::vector<RayTest> bodies = rayTests(model, camera.center);
  const auto seen = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d ray = camera.ray(pixel);
    return std::any_of(
        bodies.begin(), bodies.end(), [&](const RayTest& b) { return b.hits(ray); });
  };
  const int step =
      std::max(1, static_cast<int>(std::sqrt(double(mask.count()) / SAMPLE)));
  int own = 0, covered = 0;
  for (int y = box.y; y < box.y + box.height; y += step)
    for (int x = box.x; x < box.x + box.width; x += step)
      if (mask(x, y)) {
        ++own;
        covered += seen({double(x), double(y)});
      }
  if (own == 0)
    return verdict;
  verdict.pixels = double(covered) / double(own);
  const auto through =
      std::count_if(observed.free_space.begin(), observed.free_space.end(), seen);
  const double scale = std::pow(spacing(observed.free_space) / step, 2);
  verdict.background =
      double(covered) / std::max(1.0, double(covered) + scale * double(through));
  return verdict;
}

} // namespace pcl_sq::detail
