// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_parts.h"

#include "util/parallel_for.h"
#include "util/point_set.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <mutex>

namespace pcl_sq {

namespace {

/** \brief Where the points begin along a direction, seen from \a origin [m]; a
 * hundredth of them may be stray. */
double frontOf(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
               const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction) {
  std::vector<double> along;
  along.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      along.push_back(direction.dot(points.col(i) - origin));
  if (along.empty())
    return 0.0;
  const auto front = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 100);
  std::nth_element(along.begin(), front, along.end());
  return *front;
}

FitSummary fitPart(const RoiBox& region,
                   const Eigen::Matrix3d& object_rotation,
                   const CloudPoints& cloud,
                   const EstimationOptions& options) {
  if (options.fit == FitMode::FULL) {
    FitSummary flat; // no volume can be told from a plane, a line or a point
    flat.termination = Termination::DEGENERATE;
    return spansVolume(cloud) ? fitSuperquadric(cloud, options.full_fit) : flat;
  }
  const Eigen::Matrix3Xd points = cloud.cast<double>();
  // III-B: the region's centre, the principal axes, a1 and a2 from the extents
  Eigen::Vector3d center = options.center == CenterRule::MEAN
                               ? detail::momentsOf(points).mean
                               : region.center();
  const Eigen::Matrix3d rotation =
      options.pca == PcaScope::PART ? principalAxes(points) : object_rotation;
  const double depth = region.sizes().z();
  PaperFitOptions paper = options.paper_fit;
  if (options.center == CenterRule::FRONT) {
    const Eigen::Vector3d backwards = rotation.col(2);
    center += (frontOf(points, center, backwards) + 0.5 * depth) * backwards;
    paper.keep_front = true;
    paper.max_depth_ratio = std::min(1.0, paper.max_depth_ratio);
  }
  const Superquadric initial =
      initialSuperquadric(points, center, rotation, depth, paper);
  // Eqs. (5)-(7): e1, e2 and a3
  return fitSuperquadricPaper(points, initial, paper);
}

} // namespace

std::vector<PartFit>
fitParts(const std::vector<RoiBox>& regions,
         const Eigen::Matrix3d& object_rotation,
         const std::function<Eigen::Matrix3Xf(std::size_t)>& points,
         const EstimationOptions& options,
         unsigned int threads) {
  std::vector<PartFit> fits(regions.size());
  std::mutex mutex;
  std::size_t done = 0;
  detail::parallelFor(regions.size(), threads, [&](std::size_t i) {
    const detail::Stopwatch watch;
    fits[i].summary = fitPart(regions[i], object_rotation, points(i), options);
    fits[i].milliseconds = watch.milliseconds();
    if (options.progress) {
      const std::lock_guard<std::mutex> lock(mutex);
      options.progress("fit", double(++done) / double(fits.size()));
    }
  });
  return fits;
}

} // namespace pcl_sq
