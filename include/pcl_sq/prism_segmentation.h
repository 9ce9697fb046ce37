// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/prism.h"

#include <pcl/pcl_base.h>

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Splits an object's points by rectangular prisms of connected voxels (paper,
 * III-C, Fig. 4).
 *
 * The voxels come from AdaptiveVoxelGrid::getVoxelLayout(). A point belongs to a prism
 * if its voxel is valid and lies in the prism; prisms overlap, so that a point may
 * belong to several, as in the paper, or with setExclusive() to the smallest alone.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class PrismSegmentation : public pcl::PCLBase<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<PrismSegmentation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const PrismSegmentation<PointT>>;

  /** \brief Sets the grid, with its counts. */
  void setVoxelLayout(const VoxelLayout& layout) { layout_ = layout; }
  const VoxelLayout& getVoxelLayout() const { return layout_; }
  /** \brief Sets all options at once; kept as they were if not valid. */
  void setOptions(const PrismOptions& options);
  const PrismOptions& getOptions() const { return options_; }
  /** \brief Whether each point goes to the smallest of its prisms alone. */
  void setExclusive(bool exclusive) { exclusive_ = exclusive; }
  bool getExclusive() const { return exclusive_; }

  /** \brief Finds the prisms and their points.
   * \param[out] clusters the points of each prism, in the order of getPrisms(); indices
   * into the input cloud, in the order of the input indices
   * \return false, with no clusters and a PCL_WARN, if there is no prism */
  [[nodiscard]] bool segment(std::vector<pcl::PointIndices>& clusters);

  /** \brief The prisms of the last segment(). */
  const std::vector<Prism>& getPrisms() const { return prisms_; }

protected:
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::initCompute;
  using pcl::PCLBase<PointT>::deinitCompute;

private:
  VoxelLayout layout_;
  PrismOptions options_;
  bool exclusive_ = false;
  std::vector<Prism> prisms_;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/prism_segmentation.hpp"
