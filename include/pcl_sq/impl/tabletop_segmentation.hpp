// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/tabletop_segmentation.h"

#include <pcl/console/print.h>

#include <limits>

namespace pcl_sq {

template <typename PointT>
void TabletopSegmentation<PointT>::setOptions(const TabletopOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::TabletopSegmentation::setOptions] %s; the options stay as they "
              "were.\n",
              why.c_str());
}

template <typename PointT>
bool TabletopSegmentation<PointT>::segment(pcl::Indices& object) {
  object.clear();
  if (!initCompute())
    return false;
  failure_.clear();
  const pcl::Indices* const lists[] = {indices_.get(), candidates_.get()};
  for (const pcl::Indices* named : lists)
    if (const char* wrong =
            named ? detail::contradictionOf(*input_, *named) : nullptr) {
      failure_ = wrong;
      PCL_WARN("[pcl_sq::TabletopSegmentation::segment] %s.\n", wrong);
      deinitCompute();
      return false;
    }
  // an image stays one where points are left out
  const bool image = input_->isOrganized();
  const std::size_t count = image ? input_->size() : indices_->size();
  Eigen::Matrix3Xf points = Eigen::Matrix3Xf::Constant(
      3, static_cast<Eigen::Index>(count), std::numeric_limits<float>::quiet_NaN());
  std::vector<pcl::index_t> index_of(count, 0);
  for (std::size_t i = 0; i < indices_->size(); ++i) {
    const auto index = (*indices_)[i];
    const std::size_t column = image ? static_cast<std::size_t>(index) : i;
    points.col(static_cast<Eigen::Index>(column)) =
        (*input_)[static_cast<std::size_t>(index)].getVector3fMap();
    index_of[column] = index;
  }
  std::vector<bool> candidates;
  if (candidates_) {
    std::vector<bool> of_cloud(input_->size(), false);
    for (const auto index : *candidates_)
      of_cloud[static_cast<std::size_t>(index)] = true;
    for (const auto index : index_of)
      candidates.push_back(of_cloud[static_cast<std::size_t>(index)]);
  }
  TabletopOptions options = options_;
  const Eigen::Vector3d origin =
      input_->sensor_origin_.template head<3>().template cast<double>();
  if (!options.viewpoint && origin.norm() > 0.0)
    options.viewpoint = origin;
  std::vector<int> columns;
  const bool found = findTabletopObject(points,
                                        image ? static_cast<int>(input_->width)
                                              : static_cast<int>(count),
                                        image ? static_cast<int>(input_->height) : 1,
                                        candidates,
                                        options,
                                        table_,
                                        columns,
                                        &failure_);
  if (!found)
    PCL_WARN("[pcl_sq::TabletopSegmentation::segment] %s.\n", failure_.c_str());
  object.reserve(columns.size());
  for (const int column : columns)
    object.push_back(index_of[static_cast<std::size_t>(column)]);
  deinitCompute();
  return found;
}

} // namespace pcl_sq
