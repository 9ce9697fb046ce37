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

/** \brief The algorithm of ObjectSurfaceEstimation. \param[in] input null if there is
 * none */
[[nodiscard]] PCL_SQ_EXPORTS bool estimateSurface(const EstimationInput* input,
                                                  const EstimationOptions& options,
                                                  unsigned int threads,
                                                  MultiSuperquadric& model,
                                                  EstimationReport& report);

/** \brief Takes options over if they are valid. */
PCL_SQ_EXPORTS void setOptions(const EstimationOptions& options,
                               EstimationOptions& target);

} // namespace detail

// short, for they are compiled in every user's file
template <typename PointT>
void ObjectSurfaceEstimation<PointT>::setOptions(const EstimationOptions& options) {
  detail::setOptions(options, options_);
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::estimate(MultiSuperquadric& model) {
  if (!initCompute())
    return detail::estimateSurface(nullptr, options_, threads_, model, report_);
  const auto& origin = input_->sensor_origin_;
  const detail::EstimationInput input{detail::coordinatesOf(*input_),
                                      detail::columnsOf(*input_),
                                      static_cast<int>(input_->height),
                                      {origin[0], origin[1], origin[2]},
                                      input_->header,
                                      *indices_,
                                      use_indices_ && !fake_indices_,
                                      region_};
  const bool found =
      detail::estimateSurface(&input, options_, threads_, model, report_);
  deinitCompute();
  return found;
}

} // namespace pcl_sq
