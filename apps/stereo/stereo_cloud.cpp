// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_cloud.h"

#include <pcl/common/io.h>

#include <cmath>
#include <limits>

namespace pcl_sq::app {

LoadedCloud toLoadedCloud(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                          const pcl::Indices* keep) {
  constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
  LoadedCloud result;
  result.has_color = true;
  result.cloud.reset(new pcl::PointCloud<pcl::PointXYZRGBA>);
  pcl::copyPointCloud(cloud, *result.cloud);
  if (keep != nullptr) {
    std::vector<bool> kept(cloud.size(), false);
    for (const pcl::index_t i : *keep)
      kept[static_cast<std::size_t>(i)] = true;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (!kept[i]) {
        auto& p = (*result.cloud)[i];
        p.x = p.y = p.z = NOTHING;
      }
  }
  for (const auto& p : *result.cloud)
    result.finite_points += std::isfinite(p.z) ? 1 : 0;
  return result;
}

} // namespace pcl_sq::app
