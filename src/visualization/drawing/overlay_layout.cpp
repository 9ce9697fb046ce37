// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/overlay.h"

#include <algorithm>

namespace pcl_sq {

OverlayLayout::OverlayLayout(const SnapshotScene& scene) {
  const SnapshotOptions& o = scene.options;
  const int side = std::min(o.width, o.height);
  if (side < 160)
    return;
  text = std::max(11.0, side / 44.0);
  double top = 0.0;
  if (!o.title.empty())
    top += 1.9 * text;
  if (!o.caption.empty())
    top += 1.6 * text;
  margins.top += top / o.height;
  if (o.axes || o.scale_bar)
    margins.bottom += 2.2 * text / o.height;
  if (scene.showsLegend())
    margins.right += 4.0 * text / o.width;
  if (o.axes)
    margins.left += 4.0 * text / o.width;
}

} // namespace pcl_sq
