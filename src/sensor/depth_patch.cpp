// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/depth_patch.h"

namespace pcl_sq::detail {

DepthPatch::DepthPatch(const Observation& o, const CellRect& box)
    : rect_{box.x - MARGIN,
            box.y - MARGIN,
            box.width + 2 * MARGIN,
            box.height + 2 * MARGIN},
      depth_(static_cast<std::size_t>(rect_.area()), 0.0), own_(depth_.size(), 0) {
  const CellRect seen = intersection(rect_, {0, 0, o.width, o.height});
  for (int y = seen.y; y < seen.y + seen.height; ++y)
    for (int x = seen.x; x < seen.x + seen.width; ++x) {
      const int c = y * o.width + x;
      if (!o.finite(c))
        continue;
      const std::size_t i = indexOf(x, y);
      depth_[i] = o.out.camera.depthOf(o.at(c));
      own_[i] = o.out.pixels.cells[std::size_t(c)] != 0;
    }
}

void DepthPatch::markOthers(const Observation& o) {
  other_.assign(depth_.size(), 0);
  const CellRect seen = intersection(rect_, {0, 0, o.width, o.height});
  for (int y = seen.y; y < seen.y + seen.height; ++y)
    for (int x = seen.x; x < seen.x + seen.width; ++x) {
      const int c = y * o.width + x;
      const std::size_t i = indexOf(x, y);
      if (o.out.pixels.cells[std::size_t(c)] || !o.finite(c))
        continue;
      other_[i] = !o.out.table || o.out.table->height(o.at(c)) >
                                      4.0 * o.out.table->sigma + 0.01 * depth_[i];
    }
}

std::size_t DepthPatch::around(const std::vector<std::uint8_t>& chosen,
                               int x,
                               int y,
                               int reach,
                               double* depths) const {
  std::size_t count = 0;
  for (int dy = -reach; dy <= reach; ++dy) {
    const std::size_t row = indexOf(x - reach, y + dy);
    for (std::size_t i = row; i <= row + 2 * std::size_t(reach); ++i) {
      depths[count] = depth_[i]; // overwritten by the next unless it was chosen
      count += chosen[i];
    }
  }
  return count;
}

} // namespace pcl_sq::detail
