// SPDX-License-Identifier: BSD-3-Clause
#include "scene/open_ground.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace pcl_sq::detail {

namespace {

constexpr int GAP = 2; ///< pixels that miss in what encloses others

constexpr std::pair<int, int> AROUND[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

/** \brief Calls a function with each set of pixels of a mask that hang together. */
template <typename Use>
void forEachRegion(CellMask left, const Use& use) {
  std::vector<int> region;
  const int w = left.width;
  for (int start = 0; start < int(left.cells.size()); ++start) {
    if (!left.cells[std::size_t(start)])
      continue;
    region.assign(1, start);
    left.cells[std::size_t(start)] = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      const int x = region[i] % w, y = region[i] / w;
      for (const auto& [dx, dy] : AROUND)
        if (left(x + dx, y + dy)) {
          region.push_back((y + dy) * w + x + dx);
          left.cells[std::size_t(region.back())] = 0;
        }
    }
    use(region);
  }
}

CellMask maskOf(const std::vector<int>& pixels, int width, int height) {
  CellMask mask(width, height);
  for (const int c : pixels)
    mask.cells[std::size_t(c)] = 1;
  return mask;
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
  std::vector<int> largest;
  forEachRegion(std::move(ground), [&largest](const std::vector<int>& region) {
    if (region.size() > largest.size())
      largest = region;
  });
  return maskOf(largest, above.width, above.height);
}

CellMask gapsWithin(const CellMask& pixels, const CellMask& missing, std::size_t most) {
  std::vector<int> gaps;
  forEachRegion(missing, [&](const std::vector<int>& region) {
    const bool enclosed = std::all_of(region.begin(), region.end(), [&](int c) {
      const int x = c % missing.width, y = c / missing.width;
      return std::all_of(std::begin(AROUND), std::end(AROUND), [&](const auto& d) {
        return pixels(x + d.first, y + d.second) || missing(x + d.first, y + d.second);
      });
    });
    if (enclosed && region.size() <= most)
      gaps.insert(gaps.end(), region.begin(), region.end());
  });
  return maskOf(gaps, pixels.width, pixels.height);
}

} // namespace pcl_sq::detail
