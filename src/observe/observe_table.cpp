// SPDX-License-Identifier: BSD-3-Clause
// The table under an object: found around it in its image, checked against its points.
#include "observe/observe_parts.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int PLANES = 3; ///< largest ones among which the table is

/** \brief Where a plane is, as seen from the object. */
enum class TableRelation { UNDER, ABOVE, FAR };

TableRelation relationTo(const TableModel& table, const ObservedObject& observed) {
  const double tolerance = 5.0 * table.sigma + 0.1 * observed.extent;
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < observed.points.cols(); ++i)
    heights.push_back(table.height(observed.points.col(i)));
  const auto at = [&heights](std::size_t index) {
    const auto place = heights.begin() + std::ptrdiff_t(index);
    std::nth_element(heights.begin(), place, heights.end());
    return *place;
  };
  if (at(heights.size() / 5) < -tolerance)
    return TableRelation::ABOVE;
  return at(heights.size() / 50) > observed.extent ? TableRelation::FAR
                                                   : TableRelation::UNDER;
}

} // namespace

void findTable(Observation& o, const CellRect& box) {
  const int margin = std::max(20, (box.width + box.height - 2) / 3);
  std::vector<Eigen::Vector3d> around;
  const int x0 = std::max(0, box.x - margin),
            x1 = std::min(o.width - 1, box.x + box.width - 1 + margin);
  const int y0 = std::max(0, box.y - margin / 3);
  const int y1 = std::min(o.height - 1, box.y + box.height - 1 + margin);
  const int step = std::max(
      1, static_cast<int>(std::sqrt(double(x1 - x0 + 1) * (y1 - y0 + 1) / 6000.0)));
  for (int y = y0; y <= y1; y += step)
    for (int x = x0; x <= x1; x += step) {
      const int c = y * o.width + x;
      bool near = false; // the rim has the object's depth
      for (int d = -4; d <= 4 && !near; d += 2)
        near = o.out.pixels(x + d, y) || o.out.pixels(x, y + d);
      if (!near && o.finite(c))
        around.push_back(o.at(c));
    }
  // the largest plane may be a wall behind the object
  for (int attempt = 0; attempt < PLANES; ++attempt) {
    TableModel table;
    if (!findPlane(around, o.out.camera.center, 0.008 * o.out.depth, table))
      break;
    if (relationTo(table, o.out) == TableRelation::UNDER) {
      o.out.table = table;
      return;
    }
    std::vector<Eigen::Vector3d> rest;
    for (const Eigen::Vector3d& p : around)
      if (std::abs(table.height(p)) > 0.016 * o.out.depth)
        rest.push_back(p);
    around.swap(rest);
  }
  o.out.notes.push_back(
      "no table was found under the object, so its lower end is where its points end; "
      "give the table if there is one");
}

void checkTable(ObservedObject& observed) {
  if (!observed.table || observed.points.cols() == 0)
    return;
  const TableRelation relation = relationTo(*observed.table, observed);
  if (relation == TableRelation::ABOVE)
    observed.notes.push_back(
        "the object lies below the table plane, which is left out; check the table and "
        "its sign");
  else if (relation == TableRelation::FAR)
    observed.notes.push_back(
        "the object does not stand on the table plane, which is left out; check the "
        "table");
  if (relation != TableRelation::UNDER)
    observed.table.reset();
}

} // namespace pcl_sq::detail
