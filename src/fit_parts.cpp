// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_parts.h"

#include "point_set.h"
#include "stopwatch.h"

#include <exception>

#include <omp.h>

namespace pcl_sq {

namespace {

FitSummary fitPart(const RoiBox& region,
                   const Eigen::Matrix3d& object_rotation,
                   const Eigen::Matrix3Xd& points,
                   const EstimationOptions& options) {
  if (options.fit == FitMode::FULL) {
    FitSummary flat; // no volume can be told from a plane, a line or a point
    flat.termination = Termination::DEGENERATE;
    return detail::spannedDimensions(points) < 3
               ? flat
               : fitSuperquadric(points, options.full_fit);
  }
  // III-B: the region's centre, the principal axes, a1 and a2 from the extents
  const Eigen::Vector3d center = options.center == CenterRule::MEAN
                                     ? detail::momentsOf(points).mean
                                     : region.center();
  const Eigen::Matrix3d rotation =
      options.pca == PcaScope::PART ? principalAxes(points) : object_rotation;
  const Superquadric initial = initialSuperquadric(
      points, center, rotation, region.sizes().z(), options.paper_fit);
  // Eqs. (5)-(7): e1, e2 and a3
  return fitSuperquadricPaper(points, initial, options.paper_fit);
}

} // namespace

std::vector<PartFit>
fitParts(const std::vector<RoiBox>& regions,
         const Eigen::Matrix3d& object_rotation,
         const std::function<Eigen::Matrix3Xd(std::size_t)>& points,
         const EstimationOptions& options,
         unsigned int threads) {
  std::vector<PartFit> fits(regions.size());
  const int n_threads = threads > 0 ? int(threads) : omp_get_num_procs();
  std::exception_ptr error; // must not leave the parallel region by itself
#pragma omp parallel for schedule(dynamic) num_threads(n_threads)
  for (std::size_t i = 0; i < regions.size(); ++i) {
    try {
      const detail::Stopwatch watch;
      fits[i].summary = fitPart(regions[i], object_rotation, points(i), options);
      fits[i].milliseconds = watch.milliseconds();
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
  }
  if (error)
    std::rethrow_exception(error);
  return fits;
}

} // namespace pcl_sq
