// SPDX-License-Identifier: BSD-3-Clause
#include "util/voxel_clusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace pcl_sq::detail {

namespace {

constexpr std::int64_t SPAN = 1 << 20; ///< voxels along an axis; 3 x 21 bits make a key

std::int64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (x * 2 * SPAN + y) * 2 * SPAN + z;
}

struct Voxel {
  std::int64_t x, y, z;
  int cluster;
};

} // namespace

std::vector<std::vector<int>>
clustersOf(const CloudPoints& points, const std::vector<int>& columns, double gap) {
  if (columns.empty())
    return {};
  Eigen::Vector3d low = points.col(columns[0]).cast<double>();
  for (const int i : columns)
    low = low.cwiseMin(points.col(i).cast<double>());
  std::unordered_map<std::int64_t, int> index;
  std::vector<Voxel> voxels;
  std::vector<int> voxel_of;
  voxel_of.reserve(columns.size());
  for (const int i : columns) {
    const Eigen::Vector3d cell = (points.col(i).cast<double>() - low) / gap;
    std::int64_t c[3]; // a point far off shares the last voxel: it stays an outlier
    for (int k = 0; k < 3; ++k)
      c[k] = 1 + std::int64_t(std::min(cell[k], double(SPAN - 3)));
    const auto [it, added] =
        index.try_emplace(keyOf(c[0], c[1], c[2]), int(voxels.size()));
    if (added)
      voxels.push_back({c[0], c[1], c[2], -1});
    voxel_of.push_back(it->second);
  }
  int clusters = 0;
  std::vector<int> stack;
  for (std::size_t seed = 0; seed < voxels.size(); ++seed) {
    if (voxels[seed].cluster >= 0)
      continue;
    voxels[seed].cluster = clusters;
    stack.push_back(int(seed));
    while (!stack.empty()) {
      const Voxel v = voxels[stack.back()];
      stack.pop_back();
      for (int n = 0; n < 27; ++n) {
        const auto it =
            index.find(keyOf(v.x + n % 3 - 1, v.y + n / 3 % 3 - 1, v.z + n / 9 - 1));
        if (it == index.end() || voxels[it->second].cluster >= 0)
          continue;
        voxels[it->second].cluster = clusters;
        stack.push_back(it->second);
      }
    }
    ++clusters;
  }
  std::vector<std::vector<int>> result(static_cast<std::size_t>(clusters));
  for (std::size_t i = 0; i < columns.size(); ++i)
    result[std::size_t(voxels[std::size_t(voxel_of[i])].cluster)].push_back(columns[i]);
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size();
  });
  return result;
}

} // namespace pcl_sq::detail
