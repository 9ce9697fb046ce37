// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/roi_estimator.h"

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>

#include <algorithm>

namespace pcl_sq {

template <typename PointT>
void RoiEstimator<PointT>::setHistogramOptions(const DepthHistogramOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::RoiEstimator::setHistogramOptions] %s; the old options are "
              "kept.\n",
              why.c_str());
}

template <typename PointT>
bool RoiEstimator<PointT>::estimate(RoiBox& region, pcl::Indices& points) {
  region = RoiBox();
  points.clear();
  histogram_ = DepthHistogram();
  if (!initCompute())
    return false;
  std::string why;
  if (const char* wrong = detail::contradictionOf(*input_, *indices_))
    why = wrong;
  const bool found =
      why.empty() && findPoints(points, why) && findBox(points, region, why);
  deinitCompute();
  if (!found) {
    region = RoiBox();
    points.clear();
    PCL_WARN("[pcl_sq::RoiEstimator::estimate] %s.\n", why.c_str());
  }
  return found;
}

template <typename PointT>
bool RoiEstimator<PointT>::findPoints(pcl::Indices& points, std::string& why) {
  if (!rect_.empty() && !input_->isOrganized()) {
    why = "a 2D region needs an organized cloud; leave it empty for this one";
    return false;
  }
  const auto width = static_cast<pcl::index_t>(input_->width);
  std::vector<float> depths;
  std::size_t pixels = 0;
  for (const auto index : *indices_) {
    if (!rect_.empty() && !rect_.contains(index % width, index / width))
      continue;
    ++pixels;
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    if (!pcl::isXYZFinite(point))
      continue;
    points.push_back(index);
    depths.push_back(point.z);
  }
  if (pixels == 0) {
    why = "the 2D region holds no pixels of the cloud; check its position";
    return false;
  }
  if (!computeDepthHistogram(depths, pixels, options_, histogram_, &why))
    return false;
  points.erase(std::remove_if(points.begin(),
                              points.end(),
                              [this](pcl::index_t index) {
                                return !histogram_.contains(
                                    (*input_)[static_cast<std::size_t>(index)].z);
                              }),
               points.end());
  return true;
}

template <typename PointT>
bool RoiEstimator<PointT>::findBox(const pcl::Indices& points,
                                   RoiBox& region,
                                   std::string& why) const {
  region.min.setConstant(std::numeric_limits<double>::infinity());
  region.max = -region.min;
  for (const auto index : points) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    const Eigen::Vector3d p(point.x, point.y, point.z);
    region.min = region.min.cwiseMin(p);
    region.max = region.max.cwiseMax(p);
  }
  region.min.z() = histogram_.nearDepth();
  region.max.z() = histogram_.farDepth();
  return extent_ == RoiExtent::POINTS || findSidesAtMedianDepth(region, why);
}

template <typename PointT>
bool RoiEstimator<PointT>::findSidesAtMedianDepth(RoiBox& region,
                                                  std::string& why) const {
  const auto width = static_cast<pcl::index_t>(input_->width);
  PixelRays rays[2];
  for (const auto index : *indices_) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    if (!pcl::isXYZFinite(point) || !(point.z > 0.0f))
      continue;
    const double z = point.z;
    const auto row = index / width, column = index % width;
    rays[0].add(column, point.x / z);
    rays[1].add(row, point.y / z);
  }
  if (rect_.empty() || !rays[0].isValid() || !rays[1].isValid()) {
    why = "the sides at the median depth need a 2D region of an organized cloud in the "
          "frame of its pinhole camera; use RoiExtent::POINTS for this one";
    return false;
  }
  const int first[2] = {rect_.x, rect_.y}, size[2] = {rect_.width, rect_.height};
  for (int axis = 0; axis < 2; ++axis) {
    // pixel centres have whole coordinates, the rectangle's sides lie between pixels
    const double low = first[axis] - 0.5, high = low + size[axis];
    region.min[axis] = histogram_.median_depth * rays[axis].slopeAt(low);
    region.max[axis] = histogram_.median_depth * rays[axis].slopeAt(high);
  }
  return true;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS, RoiEstimator)
