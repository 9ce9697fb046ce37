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

void tellNoise(const StereoResult& stereo, ViewOptions& view) {
  if (stereo.disparity_sigma.empty())
    return;
  view.correlation = stereo.correlation;
  const double per_pixel = 1.0 / (stereo.intrinsics.fx * stereo.intrinsics.baseline);
  const auto* sigma = stereo.disparity_sigma.ptr<float>();
  view.noise.resize(static_cast<Eigen::Index>(stereo.cloud->size()));
  for (Eigen::Index i = 0; i < view.noise.size(); ++i) {
    const auto z = double((*stereo.cloud)[static_cast<std::size_t>(i)].z);
    view.noise[i] = std::isfinite(z)
                        ? static_cast<float>(z * z * per_pixel * double(sigma[i]))
                        : 1.0F;
  }
}

} // namespace pcl_sq::app
