// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/roi_crop.h"

#include <pcl/common/eigen.h>
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
  const Eigen::Vector4f min_pt = this->getMin(), max_pt = this->getMax();
  return {min_pt.template head<3>().template cast<double>(),
          max_pt.template head<3>().template cast<double>()};
}

// pcl::CropBox itself takes NaN for a point inside of the box if the cloud claims to be
// dense, and writes over the end of its list if there are more indices than points.
template <typename PointT>
void RoiCrop<PointT>::applyFilter(pcl::Indices& indices) {
  indices.clear();
  removed_indices_->clear();
  if (const char* wrong = detail::contradictionOf(*input_, *indices_)) {
    PCL_ERROR("[pcl_sq::%s::applyFilter] %s.\n", filter_name_.c_str(), wrong);
    return;
  }
  const Eigen::Vector3f angles = this->getRotation();
  const Eigen::Affine3f from_box =
      pcl::getTransformation(0.0f, 0.0f, 0.0f, angles.x(), angles.y(), angles.z());
  const Eigen::Affine3f to_box = from_box.inverse(Eigen::Isometry) *
                                 Eigen::Translation3f(-this->getTranslation()) *
                                 this->getTransform();
  const bool is_identity = to_box.matrix().isIdentity(0.0f);
  const Eigen::Vector4f min_pt = this->getMin(), max_pt = this->getMax();
  const Eigen::Array3f low = min_pt.template head<3>(),
                       high = max_pt.template head<3>();
  for (const auto index : *indices_) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    if (!pcl::isXYZFinite(point))
      continue;
    Eigen::Vector3f p(point.x, point.y, point.z);
    if (!is_identity)
      p = to_box * p;
    const bool inside = (p.array() >= low).all() && (p.array() <= high).all();
    if (inside != negative_)
      indices.push_back(index);
    else if (extract_removed_indices_)
      removed_indices_->push_back(index);
  }
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS, RoiCrop)
