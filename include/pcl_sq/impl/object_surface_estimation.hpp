// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/object_surface_estimation.h"

namespace pcl_sq {

namespace detail {

/** \brief What ObjectSurfaceEstimation takes from a cloud, whatever its points are. */
struct EstimationInput {
  CoordinateMap points;
  int width, height;
  Eigen::Vector3d sensor_origin; ///< [m]
  const pcl::PCLHeader& header;
  const pcl::Indices& indices;
  bool chosen;                         ///< whether the user named the indices
  const std::optional<RoiBox>& region; ///< where the object is looked for
};

/** \brief The algorithm of ObjectSurfaceEstimation. */
[[nodiscard]] PCL_SQ_EXPORTS bool estimateSurface(const EstimationInput& input,
                                                  const EstimationOptions& options,
                                                  unsigned int threads,
                                                  MultiSuperquadric& model,
                                                  EstimationReport& report);

} // namespace detail

template <typename PointT>
void ObjectSurfaceEstimation<PointT>::setOptions(const EstimationOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::ObjectSurfaceEstimation::setOptions] %s; the options stay as "
              "they were.\n",
              why.c_str());
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::estimate(MultiSuperquadric& model) {
  model = {};
  report_ = {};
  if (!initCompute()) {
    report_.failure = "there is no input cloud; call setInputCloud first";
    PCL_WARN("[pcl_sq::ObjectSurfaceEstimation::estimate] %s.\n",
             report_.failure.c_str());
    return false;
  }
  const bool found = detail::estimateSurface(
      {detail::coordinatesOf(*input_),
       static_cast<int>(input_->width),
       static_cast<int>(input_->height),
       input_->sensor_origin_.template head<3>().template cast<double>(),
       input_->header,
       *indices_,
       use_indices_ && !fake_indices_,
       region_},
      options_,
      threads_,
      model,
      report_);
  deinitCompute();
  return found;
}

} // namespace pcl_sq
