// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/adaptive_voxel_grid.h"
#include "pcl_sq/impl/for_each_voxel.hpp"

#include <pcl/common/centroid.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/type_traits.h>

#include <boost/mpl/size.hpp>

#include <limits>

namespace pcl_sq {
namespace detail {

template <typename PointT>
constexpr bool HAS_MORE_THAN_XYZ =
    boost::mpl::size<typename pcl::traits::fieldList<PointT>::type>::value > 3;

} // namespace detail

template <typename PointT>
AdaptiveVoxelGrid<PointT>::AdaptiveVoxelGrid(bool extract_removed_indices)
    : pcl::Filter<PointT>(extract_removed_indices) {
  filter_name_ = "AdaptiveVoxelGrid";
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setRegion(const RoiBox& region) {
  if (!(region.min.array() <= region.max.array()).all()) {
    PCL_ERROR("[pcl_sq::%s::setRegion] The region's min is above its max or not a "
              "number; the old region is kept.\n",
              filter_name_.c_str());
    return;
  }
  region_ = region;
  has_region_ = true;
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setOptions(const VoxelOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::%s::setOptions] %s; the old options are kept.\n",
              filter_name_.c_str(),
              why.c_str());
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setPercent(const Eigen::Vector3d& percent) {
  VoxelOptions options = options_;
  options.rule = VoxelRule::PERCENT;
  options.percent = percent;
  setOptions(options);
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setTargetSize(double size,
                                              int min_divisions,
                                              int max_divisions) {
  VoxelOptions options = options_;
  options.rule = VoxelRule::TARGET_SIZE_CLAMPED;
  options.target_size = size;
  options.min_divisions = min_divisions;
  options.max_divisions = max_divisions;
  setOptions(options);
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setDivisions(const Eigen::Vector3i& divisions) {
  VoxelOptions options = options_;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions = divisions;
  setOptions(options);
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::setMinimumPointsNumberPerVoxel(
    unsigned int min_points_per_voxel) {
  options_.min_points = min_points_per_voxel;
}

template <typename PointT>
Eigen::Vector3i
AdaptiveVoxelGrid<PointT>::getGridCoordinates(float x, float y, float z) const {
  const std::int32_t index = layout_.empty() ? -1 : layout_.indexOf(x, y, z);
  if (index < 0)
    return Eigen::Vector3i::Constant(-1);
  const int row = index / layout_.divisions[0];
  return {index % layout_.divisions[0],
          row % layout_.divisions[1],
          row / layout_.divisions[1]};
}

template <typename PointT>
int AdaptiveVoxelGrid<PointT>::getCentroidIndexAt(const Eigen::Vector3i& ijk) const {
  if ((ijk.array() < 0).any() || (ijk.array() >= layout_.divisions.array()).any() ||
      leaf_layout_.empty())
    return -1;
  return leaf_layout_[static_cast<std::size_t>(ijk.dot(getDivisionMultiplier()))];
}

template <typename PointT>
int AdaptiveVoxelGrid<PointT>::getCentroidIndex(const PointT& point) const {
  return getCentroidIndexAt(getGridCoordinates(point.x, point.y, point.z));
}

template <typename PointT>
bool AdaptiveVoxelGrid<PointT>::findRegion(RoiBox& region) const {
  if (has_region_) {
    region = region_;
    return true;
  }
  constexpr float INF = std::numeric_limits<float>::infinity();
  Eigen::Array3f low = Eigen::Array3f::Constant(INF);
  Eigen::Array3f high = Eigen::Array3f::Constant(-INF);
  for (const auto index : *indices_) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    if (!pcl::isXYZFinite(point))
      continue;
    const Eigen::Array3f p(point.x, point.y, point.z);
    low = low.min(p);
    high = high.max(p);
  }
  region.min = low.cast<double>();
  region.max = high.cast<double>();
  return (low <= high).all();
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::applyFilter(PointCloud& output) {
  output.clear();
  output.is_dense = true;
  layout_ = VoxelLayout();
  leaf_layout_.clear();
  removed_indices_->clear();
  if (const char* wrong = detail::contradictionOf(*input_, *indices_)) {
    PCL_ERROR("[pcl_sq::%s::applyFilter] %s.\n", filter_name_.c_str(), wrong);
    return;
  }
  RoiBox region;
  if (!findRegion(region)) {
    PCL_WARN("[pcl_sq::%s::applyFilter] The cloud has no finite points; give one that "
             "has.\n",
             filter_name_.c_str());
    return;
  }
  std::string why;
  if (!makeVoxelLayout(region, options_, layout_, &why)) {
    PCL_ERROR("[pcl_sq::%s::applyFilter] %s.\n", filter_name_.c_str(), why.c_str());
    return;
  }
  averagePoints(output);
  if (extract_removed_indices_)
    collectRemoved();
  if (output.empty())
    PCL_WARN("[pcl_sq::%s::applyFilter] No voxel of the region holds %u points; check "
             "the region or ask for fewer divisions or points per voxel.\n",
             filter_name_.c_str(),
             layout_.min_points);
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::averagePoints(PointCloud& output) {
  // sums exist only for voxels that hold points; in double, for millions of points
  std::vector<Eigen::Vector3d> sums;
  std::vector<pcl::CentroidPoint<PointT>> others;
  const bool average_others = downsample_all_data_ && detail::HAS_MORE_THAN_XYZ<PointT>;
  leaf_layout_.assign(layout_.counts.size(), -1);
  detail::forEachVoxel(detail::coordinatesOf(*input_),
                       *indices_,
                       layout_,
                       [&](pcl::index_t index, std::int32_t cell) {
                         const PointT& point =
                             (*input_)[static_cast<std::size_t>(index)];
                         const auto voxel = static_cast<std::size_t>(cell);
                         if (layout_.counts[voxel]++ == 0) {
                           leaf_layout_[voxel] = static_cast<int>(sums.size());
                           sums.emplace_back(Eigen::Vector3d::Zero());
                           if (average_others)
                             others.emplace_back();
                         }
                         const auto slot =
                             static_cast<std::size_t>(leaf_layout_[voxel]);
                         sums[slot] += Eigen::Vector3d(point.x, point.y, point.z);
                         if (average_others)
                           others[slot].add(point);
                       });
  layout_.min_points =
      options_.min_points > 0 ? options_.min_points : validityThreshold(layout_.counts);
  output.reserve(layout_.validCount());
  for (std::size_t voxel = 0; voxel < leaf_layout_.size(); ++voxel) {
    const int slot = leaf_layout_[voxel];
    leaf_layout_[voxel] = -1;
    if (!layout_.isValid(static_cast<std::int32_t>(voxel)))
      continue;
    PointT centroid;
    if (average_others)
      others[static_cast<std::size_t>(slot)].get(centroid);
    centroid.getVector3fMap() =
        (sums[static_cast<std::size_t>(slot)] / layout_.counts[voxel])
            .template cast<float>();
    leaf_layout_[voxel] = static_cast<int>(output.size());
    output.push_back(centroid);
  }
}

template <typename PointT>
void AdaptiveVoxelGrid<PointT>::collectRemoved() {
  for (const auto index : *indices_) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    if (!pcl::isXYZFinite(point))
      continue;
    const std::int32_t cell = layout_.indexOf(point.x, point.y, point.z);
    if (cell < 0 || !layout_.isValid(cell))
      removed_indices_->push_back(index);
  }
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS, AdaptiveVoxelGrid)
