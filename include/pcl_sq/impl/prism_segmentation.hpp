// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/for_each_voxel.hpp"
#include "pcl_sq/prism_segmentation.h"

#include <pcl/console/print.h>

namespace pcl_sq {

template <typename PointT>
void PrismSegmentation<PointT>::setOptions(const PrismOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::PrismSegmentation::setOptions] %s; the old options are kept.\n",
              why.c_str());
}

template <typename PointT>
bool PrismSegmentation<PointT>::segment(std::vector<pcl::PointIndices>& clusters) {
  clusters.clear();
  prisms_.clear();
  if (!initCompute())
    return false;
  if (layout_.empty()) {
    PCL_WARN("[pcl_sq::PrismSegmentation::segment] There is no voxel grid; run "
             "AdaptiveVoxelGrid and hand its layout to setVoxelLayout().\n");
    deinitCompute();
    return false;
  }
  if (std::min(layout_.divisions[0], layout_.divisions[1]) > MAX_PRISM_CELLS) {
    PCL_ERROR(
        "[pcl_sq::PrismSegmentation::segment] The grid has %d x %d voxels in x and "
        "y, more than %d; ask for fewer divisions.\n",
        layout_.divisions[0],
        layout_.divisions[1],
        MAX_PRISM_CELLS);
    deinitCompute();
    return false;
  }
  prisms_ = scanPrisms(layout_, options_);
  do
    distribute(clusters);
  while (dropSmallest(clusters));
  deinitCompute();
  if (prisms_.empty())
    PCL_WARN("[pcl_sq::PrismSegmentation::segment] No prism holds %d points; give more "
             "points or lower min_points.\n",
             options_.min_points);
  return !prisms_.empty();
}

template <typename PointT>
void PrismSegmentation<PointT>::distribute(
    std::vector<pcl::PointIndices>& clusters) const {
  const PrismMembership membership(layout_, prisms_, exclusive_);
  clusters.assign(prisms_.size(), pcl::PointIndices());
  for (std::size_t p = 0; p < clusters.size(); ++p) {
    clusters[p].header = input_->header;
    clusters[p].indices.reserve(
        std::min(indices_->size(), membership.pointsPerPrism()[p]));
  }
  detail::forEachVoxel(
      *input_, *indices_, layout_, [&](pcl::index_t index, std::int32_t voxel) {
        for (const std::uint32_t prism : membership.prismsOf(voxel))
          clusters[prism].indices.push_back(index);
      });
}

template <typename PointT>
bool PrismSegmentation<PointT>::dropSmallest(
    const std::vector<pcl::PointIndices>& clusters) {
  const auto smallest = std::min_element(
      clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
        return a.indices.size() < b.indices.size();
      });
  if (smallest == clusters.end() ||
      smallest->indices.size() >= static_cast<std::size_t>(options_.min_points))
    return false;
  prisms_.erase(prisms_.begin() + (smallest - clusters.begin()));
  return true;
}

} // namespace pcl_sq
