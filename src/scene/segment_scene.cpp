// SPDX-License-Identifier: BSD-3-Clause
#include "scene/segment_scene.h"

#include "table/depth_regions.h"
#include "table/table_search.h"

namespace pcl_sq::detail {

LabelImage segmentScene(const SceneView& view, int min_pixels) {
  LabelImage labels(view.width, view.height);
  std::uint16_t next = 1;
  const CellMask above = pixelsAbove(view.table, view.points, view.width, view.height);
  for (const Region& region : regionsOf(view.points, above)) {
    if (int(region.pixels.size()) < min_pixels || !region.cutOnce())
      continue;
    for (const int c : region.pixels)
      labels.values[std::size_t(c)] = next;
    ++next;
  }
  return labels;
}

} // namespace pcl_sq::detail
