// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/tabletop_segmentation.h"

#include <pcl/console/print.h>

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
  Eigen::Matrix3Xf points(3, static_cast<Eigen::Index>(indices_->size()));
  for (std::size_t i = 0; i < indices_->size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        (*input_)[(*indices_)[i]].getVector3fMap();
  std::vector<bool> candidates;
  if (candidates_) {
    std::vector<bool> of_cloud(input_->size(), false);
    for (const auto index : *candidates_)
      of_cloud[static_cast<std::size_t>(index)] = true;
    for (const auto index : *indices_)
      candidates.push_back(of_cloud[static_cast<std::size_t>(index)]);
  }
  std::vector<int> columns;
  failure_.clear();
  const bool found = findTabletopObject(points,
                                        input_->sensor_origin_.template head<3>(),
                                        candidates,
                                        options_,
                                        plane_,
                                        columns,
                                        &failure_);
  if (!found)
    PCL_WARN("[pcl_sq::TabletopSegmentation::segment] %s.\n", failure_.c_str());
  object.reserve(columns.size());
  for (const int column : columns)
    object.push_back((*indices_)[column]);
  deinitCompute();
  return found;
}

} // namespace pcl_sq
