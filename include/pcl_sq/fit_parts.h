// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/estimation_options.h"
#include "pcl_sq/exports.h"
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/roi.h"

#include <functional>
#include <vector>

namespace pcl_sq {

/** \brief One part's fit and its duration. */
struct PartFit {
  FitSummary summary;
  double milliseconds = 0.0;
};

/** \brief Fits one superquadric to each part of an object (III-B), parts in parallel.
 *
 * \param[in] regions box of each part; only x and y of its centre and its depth count
 * \param[in] object_rotation principal axes of the whole object (PcaScope::OBJECT)
 * \param[in] points gives the points of a part, 3 x N in the cloud's frame [m]; called
 * once per part, from any thread
 * \param[in] threads number of threads, 0 for all cores; no result depends on it */
PCL_SQ_EXPORTS std::vector<PartFit>
fitParts(const std::vector<RoiBox>& regions,
         const Eigen::Matrix3d& object_rotation,
         const std::function<Eigen::Matrix3Xf(std::size_t part)>& points,
         const EstimationOptions& options,
         unsigned int threads);

} // namespace pcl_sq
