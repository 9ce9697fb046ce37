// SPDX-License-Identifier: BSD-3-Clause
#include "table/depth_regions.h"
#include "table/table_search.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace {

constexpr std::size_t VOTERS = 6000; ///< points in which the table is looked for

/** \brief The middle one of the depths: false matches may lie ten times as far. */
double middleDepth(const CloudPoints& points, int width) {
  std::vector<double> depths;
  const auto total = static_cast<std::size_t>(points.cols());
  for (std::size_t i = 0; i < total; i += detail::evenStep(total, width, VOTERS))
    if (points.col(Eigen::Index(i)).allFinite())
      depths.push_back(std::abs(double(points(2, Eigen::Index(i)))));
  if (depths.empty())
    return 1.0;
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

} // namespace

CellMask detail::pixelsAbove(const TableModel& table,
                             const CloudPoints& points,
                             int width,
                             int height,
                             const std::vector<int>* within) {
  CellMask above(width, height);
  // the table's noise is that of its middle; what is farther errs more, by the square
  // of its depth as triangulation does
  const double depth = middleDepth(points, width);
  const auto look = [&](std::size_t i) {
    const Eigen::Vector3f p = points.col(Eigen::Index(i));
    const double farther = std::max(1.0, double(p.z()) / depth);
    TableModel there = table;
    there.noise *= farther * farther;
    const auto standing =
        static_cast<float>(detail::standingHeight(there, double(p.z())));
    above.cells[i] = table.normal.cast<float>().dot(p) + float(table.offset) > standing;
  };
  if (within)
    for (const int c : *within)
      look(std::size_t(c));
  else
    for (std::size_t i = 0; i < above.cells.size(); ++i)
      look(i);
  return above;
}

bool findStandingObject(const CloudPoints& points,
                        int width,
                        int height,
                        std::optional<TableModel>& table,
                        CellMask& object) {
  ViewOptions view;
  view.table = table;
  const detail::Standing found = detail::findInImage(points, width, height, view);
  object = CellMask(width, height);
  for (const int c : found.thing)
    object.cells[std::size_t(c)] = 1;
  if (!found.thing.empty())
    table = found.table;
  return !found.thing.empty();
}

namespace detail {

Standing findInImage(const CloudPoints& points,
                     int width,
                     int height,
                     const ViewOptions& view,
                     const CellMask* region,
                     float size,
                     bool loose) {
  TableSearch search;
  const auto total = static_cast<std::size_t>(points.cols());
  for (std::size_t i = 0; i < total; i += evenStep(total, width, VOTERS))
    if (points.col(Eigen::Index(i)).allFinite())
      search.voters.push_back(points.col(Eigen::Index(i)).cast<double>());
  if (search.voters.size() < 100)
    return {};
  search.points_a_voter = double(evenStep(total, width, VOTERS));
  search.distance = 0.008 * middleDepth(points, width);
  search.viewpoint = Eigen::Vector3d::Zero();
  search.up = view.up;
  search.table = view.table;
  search.nested = !region; // a box names the thing
  search.at = [&points](int c) {
    return Eigen::Vector3d(points.col(c).cast<double>());
  };
  std::vector<int> inside;
  CellRect box;
  if (region) {
    box = boundingRect(*region);
    for (std::size_t i = 0; i < region->cells.size(); ++i)
      if (region->cells[i])
        inside.push_back(int(i));
  }
  search.choose = [&](const TableModel& table, const std::vector<int>* within) {
    Standing found;
    found.table = table;
    const CellMask above =
        pixelsAbove(table, points, width, height, region ? &inside : within);
    if (region)
      found.thing = thingOfBox(points, above, box, size);
    if (!region || (loose && found.thing.empty())) {
      Region best = largestThing(points, above, table);
      found.thing = std::move(best.pixels);
      found.cut = best.cut();
    }
    return found;
  };
  return search.run();
}

Standing findInRegion(const Observation& o, const CellMask& region, bool loose) {
  const CellRect box = boundingRect(region);
  const auto size = static_cast<float>(
      std::sqrt(box.area() / (o.out.camera.fx * o.out.camera.fy))); // over the depth
  return findInImage(o.points, o.width, o.height, o.view, &region, size, loose);
}

} // namespace detail

} // namespace pcl_sq
