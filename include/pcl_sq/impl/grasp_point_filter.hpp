// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_point_filter.h"
#include "pcl_sq/impl/coordinates.hpp"

#include <pcl/console/print.h>

#include <cmath>

namespace pcl_sq {

namespace detail {

/** \brief The finite ones of the points that are on a union's surface, and those that
 * are not, in the order of \a indices. */
PCL_SQ_EXPORTS void selectOnSurface(const MultiSuperquadric& model,
                                    const CoordinateMap& points,
                                    const pcl::Indices& indices,
                                    SurfaceMetric metric,
                                    double tolerance,
                                    pcl::Indices& on_surface,
                                    pcl::Indices& others);

/** \brief surfaceNoise() of some points of a cloud. */
PCL_SQ_EXPORTS double surfaceNoise(const MultiSuperquadric& model,
                                   const CoordinateMap& points,
                                   const pcl::Indices& indices);

} // namespace detail

template <typename PointT>
GraspPointFilter<PointT>::GraspPointFilter(bool extract_removed_indices)
    : pcl::FilterIndices<PointT>(extract_removed_indices) {
  filter_name_ = "GraspPointFilter";
}

template <typename PointT>
void GraspPointFilter<PointT>::setModel(const MultiSuperquadric& model) {
  std::string why;
  for (const Superquadric& part : model.parts)
    if (!part.isValid(&why)) {
      PCL_ERROR("[pcl_sq::%s::setModel] %s; the old model is kept.\n",
                filter_name_.c_str(),
                why.c_str());
      return;
    }
  model_ = model;
}

template <typename PointT>
void GraspPointFilter<PointT>::setGaugeTolerance(double tolerance) {
  if (!(tolerance >= 0.0 && std::isfinite(tolerance))) {
    PCL_ERROR("[pcl_sq::%s::setGaugeTolerance] The tolerance must not be negative; the "
              "old one is kept.\n",
              filter_name_.c_str());
    return;
  }
  gauge_tolerance_ = tolerance;
  metric_ = SurfaceMetric::GAUGE;
}

template <typename PointT>
void GraspPointFilter<PointT>::setDistanceThreshold(double threshold) {
  if (!(threshold >= 0.0 && std::isfinite(threshold))) {
    PCL_ERROR("[pcl_sq::%s::setDistanceThreshold] The threshold must not be negative; "
              "the old one is kept.\n",
              filter_name_.c_str());
    return;
  }
  distance_threshold_ = threshold;
  metric_ = SurfaceMetric::DISTANCE;
}

template <typename PointT>
void GraspPointFilter<PointT>::setSigmaThreshold(double multiples) {
  if (!(multiples >= 0.0 && std::isfinite(multiples))) {
    PCL_ERROR("[pcl_sq::%s::setSigmaThreshold] The threshold must not be negative; the "
              "old one is kept.\n",
              filter_name_.c_str());
    return;
  }
  sigma_threshold_ = multiples;
  metric_ = SurfaceMetric::SIGMA;
}

template <typename PointT>
void GraspPointFilter<PointT>::describe(const pcl::Indices& indices,
                                        pcl::PointCloud<PointGrasp>& points) const {
  points = pcl::PointCloud<PointGrasp>();
  if (!input_ || model_.empty())
    return;
  points.header = input_->header;
  points.sensor_origin_ = input_->sensor_origin_;
  points.sensor_orientation_ = input_->sensor_orientation_;
  points.is_dense = input_->is_dense;
  points.reserve(indices.size());
  for (const auto index : indices) {
    const PointT& point = (*input_)[static_cast<std::size_t>(index)];
    points.push_back(describeGraspPoint(model_, {point.x, point.y, point.z}));
  }
}

template <typename PointT>
void GraspPointFilter<PointT>::applyFilter(pcl::Indices& indices) {
  removed_indices_->clear();
  indices.clear();
  if (const char* wrong = detail::contradictionOf(*input_, *indices_)) {
    PCL_ERROR("[pcl_sq::%s::applyFilter] %s.\n", filter_name_.c_str(), wrong);
    return;
  }
  if (model_.empty())
    PCL_WARN("[pcl_sq::%s::applyFilter] There is no model and so no point on its "
             "surface; hand one to setModel().\n",
             filter_name_.c_str());
  const detail::CoordinateMap points = detail::coordinatesOf(*input_);
  double tolerance =
      metric_ == SurfaceMetric::GAUGE ? gauge_tolerance_ : distance_threshold_;
  if (metric_ == SurfaceMetric::SIGMA) {
    sigma_ = detail::surfaceNoise(model_, points, *indices_);
    tolerance = sigma_threshold_ * sigma_;
  }
  pcl::Indices others;
  detail::selectOnSurface(
      model_, points, *indices_, metric_, tolerance, indices, others);
  if (negative_)
    indices.swap(others);
  if (extract_removed_indices_)
    removed_indices_->swap(others);
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS, GraspPointFilter)
