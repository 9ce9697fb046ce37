// SPDX-License-Identifier: BSD-3-Clause
#include "table/table_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_sq::detail {

namespace {

constexpr int PLANES = 6; ///< largest ones among which the table is
/** \brief A plane with a smaller share of what is left is found with as many trials as
 * make a miss unlikely: (1 - share^3)^n = 1 %. */
constexpr PlaneDemand SMALLER = {0.1, 4600};
/** \brief A table is nearer to level than to upright. */
const double LEVEL = std::sqrt(0.5);
/** \brief A wall that faces a camera looking down by an angle a has the uprightness
 * -sin a, the table before it cos a: half of the least difference tells them apart. */
constexpr double MORE_UPRIGHT = 0.5;
constexpr double LARGE =
    0.2; ///< of the table's points: what is as large may be a table
constexpr double NESTED_SHARE = 0.5;   ///< of such a thing's points, on its top
constexpr double NESTED_THING = 0.125; ///< of that top's points: a thing on a table

} // namespace

std::size_t evenStep(std::size_t points, int width, std::size_t wanted) {
  std::size_t step = std::max<std::size_t>(1, points / wanted);
  while (std::gcd(step, std::size_t(std::max(1, width))) > 1)
    --step;
  return step;
}

std::vector<TableModel> TableSearch::sidesOf(const TableModel& plane) const {
  const TableModel other = flipped(plane);
  if (viewpoint && plane.height(*viewpoint) != 0.0)
    return {plane.height(*viewpoint) > 0.0 ? plane : other};
  if (up)
    return {plane.normal.dot(*up) >= 0.0 ? plane : other};
  return {plane, other};
}

Standing TableSearch::largestOn(const TableModel& plane) const {
  Standing best;
  for (const TableModel& side : sidesOf(plane)) {
    if (up && side.normal.dot(up->normalized()) < LEVEL)
      continue;
    Standing found = choose(side, nullptr);
    const bool better =
        best.thing.empty() || (best.cut && !found.cut) ||
        (best.cut == found.cut && found.thing.size() > best.thing.size());
    if (!found.thing.empty() && better)
      best = std::move(found);
  }
  return best;
}

bool TableSearch::findNext(const std::vector<Eigen::Vector3d>& points,
                           TableModel& plane) const {
  if (!findPlane(points, distance, {}, plane) &&
      !findPlane(points, distance, SMALLER, plane))
    return false;
  if (refine)
    refine(plane);
  return true;
}

Standing TableSearch::onNestedTable(Standing found) const {
  std::vector<Eigen::Vector3d> own;
  const std::size_t step = evenStep(found.thing.size(), 1, voters.size());
  for (std::size_t i = 0; i < found.thing.size(); i += step)
    own.push_back(at(found.thing[i]));
  TableModel top;
  if (!findPlane(own, distance, {NESTED_SHARE, SMALLER.iterations}, top) ||
      std::abs(top.normal.dot(found.table.normal)) < LEVEL)
    return found;
  if (top.normal.dot(found.table.normal) < 0.0)
    top = flipped(top);
  Standing above = choose(top, &found.thing);
  std::size_t on_top = 0;
  for (const int c : found.thing)
    on_top += std::abs(top.height(at(c))) <= distance;
  const bool is_table = !above.thing.empty() && !above.cut &&
                        double(above.thing.size()) < NESTED_THING * double(on_top);
  return is_table ? above : found;
}

Standing TableSearch::run() const {
  if (table) {
    Standing found = largestOn(*table);
    found.planes = 1;
    return found;
  }
  Standing best, cut;
  int planes = 0;
  double upright = -2.0;
  std::vector<Eigen::Vector3d> rest = voters;
  for (int attempt = 0; attempt < PLANES; ++attempt) {
    TableModel plane;
    if (!findNext(rest, plane))
      break;
    ++planes;
    Standing found = largestOn(plane);
    const double this_upright = found.table.normal.dot(upward);
    if (!found.thing.empty() && found.cut) {
      if (cut.thing.empty())
        cut = std::move(found);
    } else if (!found.thing.empty() && this_upright > upright + MORE_UPRIGHT) {
      best = std::move(found);
      upright = this_upright;
      if (upright > 1.0 - MORE_UPRIGHT) // no other can be so much more upright
        break;
    }
    std::vector<Eigen::Vector3d> left;
    for (const Eigen::Vector3d& p : rest)
      if (std::abs(plane.height(p)) > std::max(2.0 * distance, 6.0 * plane.noise))
        left.push_back(p);
    rest.swap(left);
  }
  if (best.thing.empty())
    best = std::move(cut);
  best.planes = planes;
  if (best.cut || best.thing.empty())
    return best;
  std::size_t on_table = 0;
  for (const Eigen::Vector3d& p : voters)
    on_table += std::abs(best.table.height(p)) <= distance;
  const double voting_thing = double(best.thing.size()) / points_a_voter;
  return nested && voting_thing > LARGE * double(on_table)
             ? onNestedTable(std::move(best))
             : best;
}

} // namespace pcl_sq::detail
