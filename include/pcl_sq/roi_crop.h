// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/roi.h"

#include <pcl/filters/crop_box.h>

namespace pcl_sq {

/** \brief Keeps the points of the query region (paper, II-B, Fig. 2c).
 *
 * A pcl::CropBox that takes a RoiBox and never passes a point whose coordinates are not
 * finite, not even from a cloud that claims to be dense. All settings of pcl::CropBox
 * work; the sides of the box belong to it.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class RoiCrop : public pcl::CropBox<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<RoiCrop<PointT>>;
  using ConstPtr = pcl::shared_ptr<const RoiCrop<PointT>>;

  /** \param[in] extract_removed_indices whether getRemovedIndices() is filled */
  explicit RoiCrop(bool extract_removed_indices = false);

  /** \brief Sets the box [m], in the cloud's frame (or after setTransform()).
   *
   * Its sides are rounded inwards to single precision, so that the points that pass are
   * exactly those that \a region contains. */
  void setRegion(const RoiBox& region);
  /** \brief The box [m], from setRegion() or from setMin() and setMax(). */
  RoiBox getRegion() const;

protected:
  using pcl::CropBox<PointT>::filter_name_;
  using pcl::CropBox<PointT>::indices_;
  using pcl::CropBox<PointT>::input_;
  using pcl::CropBox<PointT>::extract_removed_indices_;
  using pcl::CropBox<PointT>::removed_indices_;
  using pcl::CropBox<PointT>::negative_;
  using pcl::CropBox<PointT>::applyFilter;

  void applyFilter(pcl::Indices& indices) override;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/roi_crop.hpp"
