// SPDX-License-Identifier: BSD-3-Clause
// The gap in an object, such as between a cup and its handle.
#include "observe/observe_parts.h"
#include "tuning/observe_tuning.h"

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_gap;

/** \brief Whether the background shows through: matching gives much of a narrow gap the
 * depth of what is around it. */
bool seenThrough(const Observation& o, const std::vector<Eigen::Vector2d>& gap) {
  int known = 0, behind = 0;
  for (const Eigen::Vector2d& p : gap) {
    const int c = int(p.y()) * o.width + int(p.x());
    if (!o.finite(c))
      continue;
    ++known;
    behind += o.out.camera.depthOf(o.at(c)) > o.out.depth + 0.5 * o.out.extent;
  }
  return known > 0 && behind >= SEEN_THROUGH * known;
}

} // namespace

void findGap(Observation& o, const CellRect& box) {
  CellMask visited(box.width + 2, box.height + 2); // with a border all around
  std::vector<Eigen::Vector2i> region;
  const auto fill = [&](int x, int y) {
    region.assign(1, {x, y});
    visited.set(x, y);
    for (std::size_t i = 0; i < region.size(); ++i) {
      const Eigen::Vector2i at = region[i];
      for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0),
                                          Eigen::Vector2i(-1, 0),
                                          Eigen::Vector2i(0, 1),
                                          Eigen::Vector2i(0, -1)}) {
        const Eigen::Vector2i p = at + step;
        if (p.x() < 0 || p.y() < 0 || p.x() >= visited.width ||
            p.y() >= visited.height || visited(p.x(), p.y()) ||
            o.out.pixels(box.x + p.x() - 1, box.y + p.y() - 1))
          continue;
        visited.set(p.x(), p.y());
        region.push_back(p);
      }
    }
  };
  fill(0, 0); // all that is around the object
  std::size_t largest = std::max<std::size_t>(
      SMALLEST, std::size_t(SMALLEST_SHARE * double(o.out.pixels.count())));
  for (int y = 1; y <= box.height; ++y)
    for (int x = 1; x <= box.width; ++x) {
      if (visited(x, y) || o.out.pixels(box.x + x - 1, box.y + y - 1))
        continue;
      fill(x, y);
      if (region.size() < largest)
        continue;
      std::vector<Eigen::Vector2d> gap;
      for (const Eigen::Vector2i& p : region)
        gap.emplace_back(box.x + p.x() - 1, box.y + p.y() - 1);
      if (!seenThrough(o, gap))
        continue;
      largest = region.size();
      o.out.gap = std::move(gap);
    }
}

} // namespace pcl_sq::detail
