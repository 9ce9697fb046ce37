// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/hand_over.h"

#include <limits>

namespace pcl_sq::app {

void dropStrays(const StereoView& front, LoadedCloud& scene) {
  constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
  for (const pcl::index_t i : front.strays) {
    auto& p = (*scene.cloud)[static_cast<std::size_t>(i)];
    p.x = p.y = p.z = NOTHING;
  }
  scene.finite_points -= front.strays.size();
}

void handOver(const StereoView& front, bool whole_scene, ModelOptions& model) {
  const bool painted = !model.mask.empty();
  model.roi.clear();
  model.mask.clear();
  const CameraIntrinsics& k = front.stereo.intrinsics;
  model.intrinsics = {k.fx, k.fy, k.cx, k.cy};
  if (!whole_scene) {
    if (model.box.empty())
      for (const Eigen::Vector3d& corner : {front.region.min, front.region.max})
        model.box.insert(model.box.end(), corner.data(), corner.data() + 3);
    return;
  }
  tellView(front, painted, model.estimation.view);
  if (front.segment.mask.empty())
    model.roi = {front.rect.x, front.rect.y, front.rect.width, front.rect.height};
}

} // namespace pcl_sq::app
