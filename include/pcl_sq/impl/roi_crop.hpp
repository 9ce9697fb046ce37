// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/roi_crop.h"

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>

#include <cmath>
#include <limits>

namespace pcl_sq {

template <typename PointT>
RoiCrop<PointT>::RoiCrop(bool extract_removed_indices)
    : pcl::CropBox<PointT>(extract_removed_indices) {
  filter_name_ = "RoiCrop";
}

template <typename PointT>
void RoiCrop<PointT>::setRegion(const RoiBox& region) {
  if (!(region.min.array() <= region.max.array()).all()) {
    PCL_ERROR("[pcl_sq::%s::setRegion] The region's min is above its max or not a "
              "number; the old region is kept.\n",
              filter_name_.c_str());
    return;
  }
  constexpr float INF = std::numeric_limits<float>::infinity();
  Eigen::Vector4f low = Eigen::Vector4f::Ones(), high = Eigen::Vector4f::Ones();
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = static_cast<float>(region.min[axis]);
    if (static_cast<double>(low[axis]) < region.min[axis])
      low[axis] = std::nextafter(low[axis], INF);
    high[axis] = static_cast<float>(region.max[axis]);
    if (static_cast<double>(high[axis]) > region.max[axis])
      high[axis] = std::nextafter(high[axis], -INF);
  }
  this->setMin(low);
  this->setMax(high);
}

template <typename PointT>
RoiBox RoiCrop<PointT>::getRegion() const {
  return {this->getMin().template head<3>().template cast<double>(),
          this->getMax().template head<3>().template cast<double>()};
}

template <typename PointT>
void RoiCrop<PointT>::applyFilter(pcl::Indices& indices) {
  // pcl::CropBox trusts is_dense and takes NaN for a point inside of the box
  const pcl::IndicesPtr all = indices_;
  pcl::IndicesPtr finite(new pcl::Indices);
  finite->reserve(all->size());
  for (const auto index : *all)
    if (pcl::isXYZFinite((*input_)[static_cast<std::size_t>(index)]))
      finite->push_back(index);
  indices_ = finite;
  pcl::CropBox<PointT>::applyFilter(indices);
  indices_ = all;
}

} // namespace pcl_sq
