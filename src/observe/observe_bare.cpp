// SPDX-License-Identifier: BSD-3-Clause
// An object as bare points: with a viewpoint, the outline is that of the points as the
// camera sees them.
#include "observe/observe_parts.h"
#include "observe/point_spread.h"
#include "observe/sheets.h"
#include "sensor/camera_pose.h"
#include "sensor/depth_patch.h"
#include "sensor/local_quadric.h"
#include "tuning/observe_tuning.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_bare;

/** \brief Brings the points into an order that depends on nothing but themselves and in
 * which any of them are spread over the object: subsets are then the same whatever
 * order they were given in. */
void shuffle(const Observation& o, std::vector<int>& columns) {
  const auto key = [&o](int column) {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t bits;
      const float value = o.points(k, column);
      std::memcpy(&bits, &value, sizeof bits);
      h = (h ^ bits) * 0x9E3779B97F4A7C15ULL; // Fibonacci hashing
      h ^= h >> 29;
    }
    return h;
  };
  std::vector<std::pair<std::uint64_t, int>> order;
  for (const int c : columns)
    order.emplace_back(key(c), c);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < columns.size(); ++i)
    columns[i] = order[i].second;
}

/** \brief Takes out the points whose neighbours are far: a single one beyond the rim
 * would spoil the outline. */
void dropLonely(const Observation& o, std::vector<int>& columns) {
  const std::size_t n = columns.size();
  if (n < 10 * NEIGHBOUR)
    return;
  Eigen::Matrix3Xd points(3, Eigen::Index(n));
  for (std::size_t i = 0; i < n; ++i)
    points.col(Eigen::Index(i)) = o.at(columns[i]);
  Neighbourhood neighbourhood(points);
  std::vector<double> distance(n);
  for (std::size_t i = 0; i < n; ++i) {
    neighbourhood.of(Eigen::Index(i), 1 + NEIGHBOUR); // itself is one
    distance[i] = neighbourhood.reach();
  }
  const double limit = LONELY * median(distance);
  std::vector<int> kept;
  for (std::size_t i = 0; i < n; ++i)
    if (distance[i] <= limit)
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
    why = "fewer than " + std::to_string(MIN_POINTS) +
          " finite points are the object's; give more "
          "of it";
    return false;
  }
  shuffle(o, columns);
  if (columns.size() > tuning::observe_bare::MAX_POINTS)
    columns.resize(tuning::observe_bare::MAX_POINTS);
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
  if (out.table)
    out.foot = standingHeight(
        *out.table,
        o.view.viewpoint ? (out.points.col(0) - *o.view.viewpoint).norm() : 0.0);
  if (o.view.coverage == Coverage::COMPLETE)
    return true;
  std::optional<Eigen::Vector3d> viewpoint = o.view.viewpoint;
  const auto above_table = [&out](const Eigen::Vector3d& place) {
    return !out.table || out.table->height(place) > 0.0;
  };
  const bool one_sided = o.view.coverage == Coverage::ONE_SIDED;
  // the two sides of a pan's bottom look like one from above, but not from nearby
  if (!viewpoint && !one_sided) {
    out.surface = surfaceOf(out.points);
    if (out.surface->two_sided)
      return true;
  }
  std::optional<PointSpread> spread; // dear: only of points that may be one view
  const auto spreadOfPoints = [&]() -> const PointSpread& {
    if (!spread)
      spread.emplace(out.points);
    return *spread;
  };
  if (!viewpoint && above_table(Eigen::Vector3d::Zero()) && isCameraFrame(out.points) &&
      spreadOfPoints().allows(Eigen::Vector3d::Zero())) {
    viewpoint = Eigen::Vector3d::Zero();
    out.notes.push_back("no viewpoint is given; the points lie before the origin "
                        "and each ray from there meets them once: it is taken as the "
                        "camera's place; give it if it is another");
  }
  out.viewpoint_known = bool(viewpoint);
  if (!viewpoint) {
    viewpoint = guessViewpoint(
        out.points, one_sided, [&] { return spreadOfPoints().direction(); });
    if (viewpoint && !above_table(*viewpoint))
      viewpoint.reset();
  }
  if (viewpoint && !out.viewpoint_known)
    out.notes.push_back(
        "no viewpoint is given; the points show one side of something, "
        "and the camera is taken to be on it; give its place if it is another");
  if (!viewpoint)
    return true;
  const Eigen::Vector3d mean = out.points.rowwise().mean();
  const double distance = (mean - *viewpoint).norm();
  if (!(distance > 0.5 * out.extent)) {
    out.notes.push_back(
        "the viewpoint lies inside the object, so its outline is not used; give the "
        "camera's place in the cloud's frame");
    return true;
  }
  out.effective_points /= sharingOfErrors(out.points);
  out.camera = PinholeCamera::lookingAt(*viewpoint, mean, 500.0);
  out.depth = distance;
  // just above the table the points end before the object does
  const double floor = out.table ? lowestOutline(out) : 0.0;
  for (Eigen::Index i = 0; i < out.points.cols(); ++i) {
    if (!(out.camera.depthOf(out.points.col(i)) > 0.1 * distance))
      continue;
    ContourPoint point;
    point.pixel = out.camera.project(out.points.col(i));
    point.own = !out.table || out.table->height(out.points.col(i)) >= floor;
    out.contour.push_back(point);
  }
  out.outline = OutlineSource::POINTS;
  const double size = 500.0 * out.extent / distance; // [px]
  out.outline_sigma = 0.02 * size;
  out.outline_dilation = 0.02 * size;
  return true;
}

} // namespace pcl_sq::detail
