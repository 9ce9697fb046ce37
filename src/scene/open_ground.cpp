// SPDX-License-Identifier: BSD-3-Clause
#include "scene/open_ground.h"

#include <utility>
#include <vector>

namespace pcl_sq::detail {

namespace {

constexpr int GAP = 2; ///< pixels that miss in what encloses others

/** \brief The largest set of pixels of a mask that hang together. */
CellMask largestOf(CellMask left) {
  CellMask largest(left.width, left.height);
  std::vector<int> region, best;
  const int w = left.width;
  for (int start = 0; start < int(left.cells.size()); ++start) {
    if (!left.cells[std::size_t(start)])
      continue;
    region.assign(1, start);
    left.cells[std::size_t(start)] = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      const int x = region[i] % w, y = region[i] / w;
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
        if (left(x + dx, y + dy)) {
          region.push_back((y + dy) * w + x + dx);
          left.cells[std::size_t(region.back())] = 0;
        }
    }
    if (region.size() > best.size())
      best.swap(region);
  }
  for (const int c : best)
    largest.cells[std::size_t(c)] = 1;
  return largest;
}

} // namespace

CellMask openGround(const CellMask& above) {
  CellMask ground(above.width, above.height);
  ground.cells.assign(ground.cells.size(), 1);
  for (int y = 0; y < above.height; ++y)
    for (int x = 0; x < above.width; ++x)
      for (int v = y - GAP; above(x, y) && v <= y + GAP; ++v)
        for (int u = x - GAP; u <= x + GAP; ++u)
          if (u >= 0 && v >= 0 && u < above.width && v < above.height)
            ground.cells[ground.indexOf(u, v)] = 0;
  return largestOf(std::move(ground));
}

} // namespace pcl_sq::detail
