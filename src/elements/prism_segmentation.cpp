// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/prism_segmentation.hpp"
#include "pcl_sq/impl/for_each_voxel.hpp"

namespace pcl_sq::detail {

namespace {

/** \brief Takes out the prism with the fewest points if it has too few.
 * \return false if none has */
bool dropSmallest(const std::vector<pcl::PointIndices>& clusters,
                  int min_points,
                  std::vector<Prism>& prisms) {
  const auto smallest = std::min_element(
      clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
        return a.indices.size() < b.indices.size();
      });
  if (smallest == clusters.end() ||
      smallest->indices.size() >= static_cast<std::size_t>(min_points))
    return false;
  prisms.erase(prisms.begin() + (smallest - clusters.begin()));
  return true;
}

} // namespace

bool segmentPrisms(const CoordinateMap& points,
                   const pcl::Indices& indices,
                   const VoxelLayout& layout,
                   const PrismOptions& options,
                   bool exclusive,
                   std::vector<Prism>& prisms,
                   std::vector<pcl::PointIndices>& clusters,
                   std::string& why) {
  clusters.clear();
  prisms.clear();
  if (layout.empty()) {
    why = "There is no voxel grid; run AdaptiveVoxelGrid and hand its layout to "
          "setVoxelLayout()";
    return false;
  }
  if (const char* wrong =
          contradictionOf(static_cast<std::size_t>(points.cols()), 0, 1, indices)) {
    why = wrong;
    return false;
  }
  if (std::min(layout.divisions[0], layout.divisions[1]) > MAX_PRISM_CELLS) {
    why = "The grid has " + std::to_string(layout.divisions[0]) + " x " +
          std::to_string(layout.divisions[1]) + " voxels in x and y, more than " +
          std::to_string(MAX_PRISM_CELLS) + "; ask for fewer divisions";
    return false;
  }
  prisms = scanPrisms(layout, options);
  do {
    const PrismMembership membership(layout, prisms, exclusive);
    clusters.assign(prisms.size(), pcl::PointIndices());
    for (std::size_t p = 0; p < clusters.size(); ++p)
      clusters[p].indices.reserve(
          std::min(indices.size(), membership.pointsPerPrism()[p]));
    forEachVoxel(points, indices, layout, [&](pcl::index_t index, std::int32_t voxel) {
      for (const std::uint32_t prism : membership.prismsOf(voxel))
        clusters[prism].indices.push_back(index);
    });
  } while (dropSmallest(clusters, options.min_points, prisms));
  if (prisms.empty())
    why = "No prism holds " + std::to_string(options.min_points) +
          " points; give more points or lower min_points";
  return !prisms.empty();
}

} // namespace pcl_sq::detail
