// SPDX-License-Identifier: BSD-3-Clause
// Where an object ends at its foot: points just above a table cannot be told from it.
#include "observe/observe_parts.h"
#include "tuning/observe_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_foot;

} // namespace

double lowestOutline(const ObservedObject& out) {
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < out.points.cols(); ++i)
    heights.push_back(out.table->height(out.points.col(i)));
  const auto high = heights.begin() + std::ptrdiff_t(heights.size() * 9 / 10);
  std::nth_element(heights.begin(), high, heights.end());
  return std::min(3.0 * standingHeight(*out.table, out.depth), 0.5 * *high);
}

void findFoot(Observation& o, const CellRect& box, int rim) {
  ObservedObject& out = o.out;
  out.foot = 0.0;
  out.hidden_below = false;
  if (!out.table)
    return;
  const TableModel& table = *out.table;
  std::vector<std::pair<double, int>> heights;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      if (const int c = y * o.width + x; out.pixels(x, y) && o.finite(c))
        heights.emplace_back(table.height(o.at(c)), c);
  if (heights.empty())
    return;
  const std::size_t low = heights.size() / LOWEST + 1;
  std::nth_element(
      heights.begin(), heights.begin() + std::ptrdiff_t(low - 1), heights.end());
  heights.resize(low);
  const auto belongs = [&](const Eigen::Vector2d& pixel) {
    const int x = int(std::lround(pixel.x())), y = int(std::lround(pixel.y()));
    for (int dy = -rim; dy <= rim; ++dy)
      for (int dx = -rim; dx <= rim; ++dx)
        if (out.pixels(x + dx, y + dy))
          return true;
    return false;
  };
  // the table is seen through where the object would be, if it reached down
  const auto seenThrough = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d pixel = out.camera.project(p);
    const int x = int(std::lround(pixel.x())), y = int(std::lround(pixel.y()));
    if (x < 0 || y < 0 || x >= o.width || y >= o.height || belongs(pixel))
      return false;
    const int c = y * o.width + x;
    const double depth = out.camera.depthOf(p);
    return o.finite(c) &&
           out.camera.depthOf(o.at(c)) > depth + standingHeight(table, depth);
  };
  // another thing begins just beneath, at the same depth: it carries the object
  const auto rests = [&](int column) {
    const Eigen::Vector3d p = o.at(column);
    const double depth = out.camera.depthOf(p);
    const double pixel = depth / std::sqrt(out.camera.fx * out.camera.fy);
    for (int k = 1; k <= BENEATH; ++k) {
      const Eigen::Vector2d at = out.camera.project(p - k * pixel * table.normal);
      const int x = int(std::lround(at.x())), y = int(std::lround(at.y()));
      if (!o.view.others(x, y) || !o.finite(y * o.width + x))
        continue;
      return out.camera.depthOf(o.at(y * o.width + x)) >
             depth - standingHeight(table, depth);
    }
    return false;
  };
  const auto seenAlong = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
    for (int k = 1; k <= STEPS; ++k)
      if (seenThrough(from + way * k / STEPS))
        return true;
    return false;
  };
  // a bowl, or a cup below its handle, reaches down where it is narrower
  Eigen::Vector3d middle = out.points.rowwise().mean();
  middle -= table.height(middle) * table.normal;
  std::size_t seen = 0, resting = 0;
  for (const auto& [height, column] : heights) {
    resting += rests(column);
    const Eigen::Vector3d p = o.at(column);
    seen += seenAlong(p, -height * table.normal) && seenAlong(p, middle - p);
  }
  out.hidden_below =
      double(seen) < SEEN * double(low) && double(resting) < SEEN * double(low);
  // a pixel's height on an upright wall
  const Eigen::Vector3d ray =
      (out.points.rowwise().mean() - out.camera.center).normalized();
  const double across =
      std::sqrt(std::max(1.0 - std::pow(ray.dot(table.normal), 2), 0.01));
  const double pixel = out.depth / std::sqrt(out.camera.fx * out.camera.fy);
  out.foot = standingHeight(table, out.depth) + rim * pixel / across;
}

} // namespace pcl_sq::detail
