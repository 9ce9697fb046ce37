// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/depth_odds.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl_sq::detail {

cv::Mat oddsOfDepths(const DepthGrid& grid,
                     const cv::Mat& object,
                     const cv::Mat& box,
                     float thickness,
                     double most) {
  constexpr int SLANT = 2; // of a surface's scatter, that it goes on at either side
  struct Cells {
    double in = 0.0, all = 0.0;
  };
  Cells known, own;
  std::map<int, Cells> at_depth;
  const auto depthOf = [&](pcl::index_t i) {
    return int(std::floor((*grid.points)[std::size_t(i)].z / thickness));
  };
  for (const pcl::index_t i : grid.finite) {
    const bool in = box.ptr<std::uint8_t>()[i] != 0;
    known.in += in;
    known.all += 1.0;
    if (object.ptr<std::uint8_t>()[i] == 0)
      continue;
    Cells& c = at_depth[depthOf(i)];
    c.in += in;
    c.all += 1.0;
    own.in += in;
    own.all += 1.0;
  }
  const auto oddsOf = [&](const Cells& c) {
    const double usual_in = (c.in + 1.0) / (known.in + 1.0);
    const double usual_out = (c.all - c.in + 1.0) / (known.all - known.in + 1.0);
    return std::clamp(
        std::log(usual_in / usual_out), 0.0, most * c.in / std::max(1.0, c.all));
  };
  std::map<int, float> odds;
  for (const auto& [depth, c] : at_depth) {
    Cells near; // surfaces are slanted
    for (int d = -SLANT; d <= SLANT; ++d)
      if (const auto it = at_depth.find(depth + d); it != at_depth.end()) {
        near.in += it->second.in;
        near.all += it->second.all;
      }
    odds[depth] = float(std::min(oddsOf(own), oddsOf(near)));
  }
  cv::Mat told = cv::Mat::zeros(object.size(), CV_32F);
  for (const pcl::index_t i : grid.finite)
    if (object.ptr<std::uint8_t>()[i] != 0)
      told.ptr<float>()[i] = odds[depthOf(i)];
  return told;
}

} // namespace pcl_sq::detail
