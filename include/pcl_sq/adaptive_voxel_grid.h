// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/voxel_layout.h"

#include <pcl/filters/filter.h>

namespace pcl_sq {

/** \brief Voxel grid whose sides are fractions of the region's sides (paper, III-C,
 * Fig. 3).
 *
 * Unlike pcl::VoxelGrid the grid starts at the region's corner, so that the numbers of
 * divisions are exact wherever the cloud lies; a grid that is too large is an error
 * with an empty output. A voxel is valid if it holds enough points; the output has the
 * centroid of each valid voxel, in the order of the voxels' indices. Points outside of
 * the region, in no valid voxel or not finite do not enter it; the removed indices are
 * the finite ones among them.
 *
 * Time and memory are linear in the points and in the voxels.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class AdaptiveVoxelGrid : public pcl::Filter<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<AdaptiveVoxelGrid<PointT>>;
  using ConstPtr = pcl::shared_ptr<const AdaptiveVoxelGrid<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  /** \param[in] extract_removed_indices whether getRemovedIndices() is filled */
  explicit AdaptiveVoxelGrid(bool extract_removed_indices = false);

  /** \brief Sets the box to divide [m]; without it the points' bounding box is divided.
   */
  void setRegion(const RoiBox& region);
  /** \brief The box set; undefined if hasRegion() is false. */
  const RoiBox& getRegion() const { return region_; }
  /** \brief Whether a region is set. */
  bool hasRegion() const { return has_region_; }
  /** \brief Back to dividing the points' bounding box. */
  void unsetRegion() { has_region_ = false; }

  /** \brief Sets all options at once; kept as they were if not valid. */
  void setOptions(const VoxelOptions& options);
  const VoxelOptions& getOptions() const { return options_; }
  /** \brief Selects VoxelRule::PERCENT. \param[in] percent of the region's sides,
   * (0, 100] */
  void setPercent(const Eigen::Vector3d& percent);
  /** \brief Selects VoxelRule::TARGET_SIZE_CLAMPED. \param[in] size voxel side [m] */
  void setTargetSize(double size, int min_divisions = 10, int max_divisions = 31);
  /** \brief Selects VoxelRule::DIVISIONS. */
  void setDivisions(const Eigen::Vector3i& divisions);
  /** \brief Points that make a voxel valid; 0 (default): validityThreshold(). */
  void setMinimumPointsNumberPerVoxel(unsigned int min_points_per_voxel);
  unsigned int getMinimumPointsNumberPerVoxel() const { return options_.min_points; }
  /** \brief Whether all fields are averaged (default) or only x, y, z. */
  void setDownsampleAllData(bool downsample) { downsample_all_data_ = downsample; }
  bool getDownsampleAllData() const { return downsample_all_data_; }

  /** \brief The grid of the last filter(), with its counts; empty after an error. */
  const VoxelLayout& getVoxelLayout() const { return layout_; }
  /** \brief Sides of a voxel [m], after filter(). */
  Eigen::Vector3f getLeafSize() const { return layout_.cellSizes().cast<float>(); }
  /** \brief Numbers of divisions, after filter(). */
  Eigen::Vector3i getNrDivisions() const { return layout_.divisions; }
  /** \brief Coordinates of the first voxel: always zero. */
  Eigen::Vector3i getMinBoxCoordinates() const { return Eigen::Vector3i::Zero(); }
  /** \brief Coordinates of the last voxel, after filter(). */
  Eigen::Vector3i getMaxBoxCoordinates() const {
    return layout_.divisions - Eigen::Vector3i::Ones();
  }
  /** \brief What voxel coordinates are multiplied with to give its index. */
  Eigen::Vector3i getDivisionMultiplier() const {
    return {1, layout_.divisions[0], layout_.divisions[0] * layout_.divisions[1]};
  }
  /** \brief Coordinates of the voxel that holds (x, y, z); (-1, -1, -1) outside. */
  Eigen::Vector3i getGridCoordinates(float x, float y, float z) const;
  /** \brief Index of a voxel's centroid in the output, -1 if there is none. */
  int getCentroidIndexAt(const Eigen::Vector3i& ijk) const;
  /** \brief Index of the centroid of the voxel that holds a point, -1 if there is none.
   */
  int getCentroidIndex(const PointT& point) const;
  /** \brief For each voxel the index of its centroid in the output, or -1. */
  const std::vector<int>& getLeafLayout() const { return leaf_layout_; }

protected:
  using pcl::Filter<PointT>::filter_name_;
  using pcl::Filter<PointT>::indices_;
  using pcl::Filter<PointT>::input_;
  using pcl::Filter<PointT>::extract_removed_indices_;
  using pcl::Filter<PointT>::removed_indices_;

  void applyFilter(PointCloud& output) override;

private:
  bool findRegion(RoiBox& region) const;
  void averagePoints(PointCloud& output);
  void collectRemoved();

  VoxelOptions options_;
  RoiBox region_;
  bool has_region_ = false;
  bool downsample_all_data_ = true;
  VoxelLayout layout_;
  std::vector<int> leaf_layout_;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/adaptive_voxel_grid.hpp"
