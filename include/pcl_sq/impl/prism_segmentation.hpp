// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/prism_segmentation.h"

namespace pcl_sq {

namespace detail {

/** \brief The algorithm of PrismSegmentation. \param[out] why the reason of a failure
 * \return false if the grid is too large or no prism holds enough points */
[[nodiscard]] PCL_SQ_EXPORTS bool
segmentPrisms(const CoordinateMap& points,
              const pcl::Indices& indices,
              const VoxelLayout& layout,
              const PrismOptions& options,
              bool exclusive,
              std::vector<Prism>& prisms,
              std::vector<pcl::PointIndices>& clusters,
              std::string& why);

} // namespace detail

template <typename PointT>
void PrismSegmentation<PointT>::setOptions(const PrismOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::PrismSegmentation::setOptions] %s; the old options are kept.\n",
              why.c_str());
}

template <typename PointT>
bool PrismSegmentation<PointT>::segment(std::vector<pcl::PointIndices>& clusters) {
  clusters.clear();
  prisms_.clear();
  if (!initCompute())
    return false;
  std::string why;
  const bool found = detail::segmentPrisms(detail::coordinatesOf(*input_),
                                           *indices_,
                                           layout_,
                                           options_,
                                           exclusive_,
                                           prisms_,
                                           clusters,
                                           why);
  for (pcl::PointIndices& cluster : clusters)
    cluster.header = input_->header;
  deinitCompute();
  if (!found)
    PCL_WARN("[pcl_sq::PrismSegmentation::segment] %s.\n", why.c_str());
  return found;
}

} // namespace pcl_sq
