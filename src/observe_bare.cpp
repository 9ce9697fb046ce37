// SPDX-License-Identifier: BSD-3-Clause
// An object as bare points: with a viewpoint, the outline is that of the points as the
// camera sees them.
#include "observe_parts.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int MIN_POINTS = 12;
constexpr std::size_t NEIGHBOUR = 6;
constexpr double LONELY = 2.5; ///< times the median distance to that neighbour
constexpr std::size_t MAX_POINTS = 3000; ///< looked at and fitted

/** \brief Takes out the points whose neighbours are far: a single one beyond the rim
 * would spoil the outline. */
void dropLonely(const Observation& o, std::vector<int>& columns) {
  const std::size_t n = columns.size();
  if (n < 10 * NEIGHBOUR)
    return;
  std::vector<float> distance(n);
  std::vector<float> near;
  for (std::size_t i = 0; i < n; ++i) {
    near.clear();
    for (std::size_t k = 0; k < n; ++k)
      near.push_back(
          (o.points.col(columns[k]) - o.points.col(columns[i])).squaredNorm());
    std::nth_element(near.begin(), near.begin() + NEIGHBOUR, near.end());
    distance[i] = std::sqrt(near[NEIGHBOUR]);
  }
  std::vector<float> sorted = distance;
  std::nth_element(
      sorted.begin(), sorted.begin() + std::ptrdiff_t(n / 2), sorted.end());
  const double limit = LONELY * double(sorted[n / 2]);
  std::vector<int> kept;
  for (std::size_t i = 0; i < n; ++i)
    if (double(distance[i]) <= limit)
      kept.push_back(columns[i]);
  columns.swap(kept);
}

} // namespace

bool observeBare(Observation& o, std::string& why) {
  ObservedObject& out = o.out;
  std::vector<int> columns;
  if (o.object.empty()) {
    for (int c = 0; c < o.points.cols(); ++c)
      if (o.finite(c))
        columns.push_back(c);
  } else
    for (const int c : o.object)
      if (o.finite(c))
        columns.push_back(c);
  if (columns.size() < std::size_t(MIN_POINTS)) {
    why = "fewer than " + std::to_string(MIN_POINTS) + " finite points";
    return false;
  }
  if (columns.size() > MAX_POINTS) {
    std::vector<int> some;
    const std::size_t step = (columns.size() + MAX_POINTS - 1) / MAX_POINTS;
    for (std::size_t i = 0; i < columns.size(); i += step)
      some.push_back(columns[i]);
    columns.swap(some);
  }
  dropLonely(o, columns);
  out.columns = columns;
  out.points.resize(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    out.points.col(static_cast<Eigen::Index>(i)) = o.at(columns[i]);
  out.effective_points = double(columns.size());
  measure(out);
  if (o.view.table)
    out.table = *o.view.table;
  checkTable(out);
  std::optional<Eigen::Vector3d> viewpoint = o.view.viewpoint;
  if (!viewpoint && isCameraFrame(out.points)) {
    viewpoint = Eigen::Vector3d::Zero();
    out.notes.push_back("no viewpoint is given; the points lie before the origin "
                        "and each ray from there meets them once: it is taken as the "
                        "camera's place");
  }
  if (!viewpoint)
    return true;
  const Eigen::Vector3d mean = out.points.rowwise().mean();
  const double distance = (mean - *viewpoint).norm();
  if (!(distance > 0.5 * out.extent)) {
    out.notes.push_back(
        "the viewpoint lies inside the object; its outline is not used");
    return true;
  }
  out.camera = PinholeCamera::lookingAt(*viewpoint, mean, 500.0);
  out.depth = distance;
  std::vector<Eigen::Vector2d> pixels;
  for (Eigen::Index i = 0; i < out.points.cols(); ++i)
    if (out.camera.depthOf(out.points.col(i)) > 0.1 * distance)
      pixels.push_back(out.camera.project(out.points.col(i)));
  for (const Eigen::Vector2d& p : pixels) {
    ContourPoint point;
    point.pixel = p;
    out.contour.push_back(point);
  }
  out.outline = OutlineSource::POINTS;
  const double size = 500.0 * out.extent / distance; // [px]
  out.outline_sigma = 0.02 * size;
  out.outline_dilation = 0.02 * size;
  return true;
}

} // namespace pcl_sq::detail
