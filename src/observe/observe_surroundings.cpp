// SPDX-License-Identifier: BSD-3-Clause
// What an object is seen against: what hides it (M26) and what is seen past it.
#include "observe/observe_parts.h"
#include "sensor/depth_patch.h"
#include "tuning/observe_tuning.h"
#include "util/order_statistic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_surroundings;

} // namespace

bool occluded(const Observation& o, const DepthPatch& patch, int x, int y) {
  constexpr std::size_t WINDOW =
      std::size_t(2 * OCCLUDER_REACH + 1) * (2 * OCCLUDER_REACH + 1);
  std::array<double, WINDOW> depths, spare;
  const auto median = [&](std::size_t count) {
    return orderStatistic(depths.data(), spare.data(), count, count / 2);
  };
  const std::size_t others = patch.othersAround(x, y, OCCLUDER_REACH, depths.data());
  if (others < FEW_OTHERS)
    return false;
  const double beside = median(others);
  const std::size_t own = patch.ownAround(x, y, OCCLUDER_REACH, depths.data());
  if (own < FEW_OWN)
    return false;
  const double mine = median(own);
  return beside < mine - std::max(0.03 * mine, 0.3 * o.out.extent);
}

bool besideAnother(const Observation& o, const DepthPatch& patch, int x, int y) {
  if (o.view.others.cells.empty())
    return false;
  constexpr std::size_t SIDE = 2 * OCCLUDER_REACH + 1, WINDOW = SIDE * SIDE;
  std::array<double, WINDOW> depths, spare;
  std::size_t others = 0;
  bool near = false;
  for (int dy = -OCCLUDER_REACH; dy <= OCCLUDER_REACH; ++dy)
    for (int dx = -OCCLUDER_REACH; dx <= OCCLUDER_REACH; ++dx) {
      if (!o.view.others(x + dx, y + dy))
        continue;
      near = near || (std::abs(dx) <= tuning::observe_surroundings::BESIDE &&
                      std::abs(dy) <= tuning::observe_surroundings::BESIDE);
      const int c = (y + dy) * o.width + x + dx;
      if (o.finite(c))
        depths[others++] = double(o.points(2, c));
    }
  if (!near)
    return false;
  if (others == 0) // nothing is known of them
    return true;
  const double beside = orderStatistic(depths.data(), spare.data(), others, others / 2);
  const std::size_t own = patch.ownAround(x, y, OCCLUDER_REACH, depths.data());
  if (own == 0)
    return true;
  const double mine = orderStatistic(depths.data(), spare.data(), own, own / 2);
  return beside < mine + standingHeight(o.out.table.value_or(TableModel{}), mine);
}

void findFreeSpace(Observation& o, const CellRect& box, int margin) {
  const bool has_mask = o.out.outline == OutlineSource::MASK;
  const int reach = std::max(8, (box.width + box.height - 2) / 16);
  const double area =
      double(box.width - 1 + 2 * reach) * double(box.height - 1 + 2 * reach);
  const int step = std::max(1, int(std::sqrt(area / FREE_SPACE)));
  // of a mask its outline tells what is free, whatever neighbours' depths share
  const double correlation =
      has_mask ? std::min(o.view.correlation, OUTLINE_CORRELATION) : o.view.correlation;
  o.out.free_weight = std::min(1.0, std::pow(step / correlation, 2));
  const auto beside = [&](int x, int y) {
    for (int dy = -margin; dy <= margin; ++dy)
      for (int dx = -margin; dx <= margin; ++dx)
        if (o.out.pixels(x + dx, y + dy))
          return false;
    return true;
  };
  const int x1 = std::min(o.width - 1, box.x + box.width - 1 + reach);
  const int y1 = std::min(o.height - 1, box.y + box.height - 1 + reach);
  for (int y = std::max(0, box.y - reach); y <= y1; y += step)
    for (int x = std::max(0, box.x - reach); x <= x1; x += step) {
      const int c = y * o.width + x;
      // without a mask only a measured background counts; an occluder never does
      const bool known = o.finite(c);
      if ((!known && (!has_mask || o.view.others(x, y))) || !beside(x, y))
        continue;
      if (!known || o.out.camera.depthOf(o.at(c)) > o.out.depth)
        o.out.free_space.emplace_back(x, y);
    }
}

} // namespace pcl_sq::detail
