// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <opencv2/core/mat.hpp>
#include <pcl/filters/filter_indices.h>
#include <pcl/point_types.h>

namespace pcl_sq {

/** \brief Removes the rim of false points around the object: the paper's "texture based
 * filter which efficiently determines the object border" (section IV).
 *
 * A block matcher gives pixels next to a contour the depth of the contour. The text
 * leaves the filter open; here a point is kept if its pixel lies in the object's mask,
 * half a block inside, or, nearer to the border, has texture of its own and a colour
 * closer to the object's than to the background's around it.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS TextureBorderFilter : public pcl::FilterIndices<pcl::PointXYZRGB> {
public:
  using Ptr = pcl::shared_ptr<TextureBorderFilter>;
  using ConstPtr = pcl::shared_ptr<const TextureBorderFilter>;

  explicit TextureBorderFilter(bool extract_removed_indices = false);

  /** \brief The object's mask: CV_8U, not 0 = object, size of the organized cloud. */
  void setMask(const cv::Mat& mask) { mask_ = mask; }
  const cv::Mat& getMask() const { return mask_; }
  /** \brief Side of the matcher's block [px], odd, 3 to 51. */
  void setBlockSize(int block_size);
  int getBlockSize() const { return block_size_; }
  /** \brief Least standard deviation of brightness in a 3 x 3 window [grey levels], 0
   * to 128. */
  void setMinTexture(double min_texture);
  double getMinTexture() const { return min_texture_; }

protected:
  void applyFilter(pcl::Indices& indices) override;

private:
  cv::Mat keptPixels() const;

  cv::Mat mask_;
  int block_size_ = 15;
  double min_texture_ = 2.0;
};

} // namespace pcl_sq
