// SPDX-License-Identifier: BSD-3-Clause
// The paper's way: prisms of connected voxels, one superquadric each.
#include "elements/surface_estimator.h"
#include "pcl_sq/fit_parts.h"
#include "pcl_sq/impl/for_each_voxel.hpp"
#include "pcl_sq/impl/prism_segmentation.hpp"

namespace pcl_sq::detail {

bool SurfaceEstimator::estimatePrisms(MultiSuperquadric& model) {
  // II-B: the points of the query region
  return run("crop", [&] { return crop(); }) &&
         // III-C, Figs. 3 and 4: voxels relative to the region, prisms of connected
         // ones
         run("decompose", [&] { return decompose(); }) &&
         // III-B, Eqs. (4)-(7): one superquadric per prism; their union is the object
         run("fit", [&] { return fitPrisms(model); }) &&
         run("evaluate", [&] { return evaluate(model); }) &&
         // III-C, end: the points on the union's surface are where a hand may touch
         run("grasp_points", [&] { return findGraspPoints(model); });
}

bool SurfaceEstimator::decompose() {
  if (options_.decomposition == Decomposition::NONE) {
    clusters_.resize(1);
    clusters_[0].indices = object_;
    return true;
  }
  std::string why;
  VoxelLayout& voxels = report_.voxels;
  if (!makeVoxelLayout(report_.region, options_.voxels, voxels, &why))
    return fail(why);
  forEachVoxel(input_.points, object_, voxels, [&](pcl::index_t, std::int32_t voxel) {
    ++voxels.counts[static_cast<std::size_t>(voxel)];
  });
  voxels.min_points = options_.voxels.min_points > 0 ? options_.voxels.min_points
                                                     : validityThreshold(voxels.counts);
  if (!segmentPrisms(input_.points,
                     object_,
                     voxels,
                     options_.prisms,
                     options_.exclusive_points,
                     report_.prisms,
                     clusters_,
                     why))
    return fail("no prism of connected voxels holds enough points; give more points or "
                "ask for fewer divisions");
  return true;
}

bool SurfaceEstimator::fitPrisms(MultiSuperquadric& model) {
  std::vector<RoiBox> regions;
  for (const Prism& prism : report_.prisms)
    regions.push_back(prism.box);
  if (regions.empty())
    regions.push_back(report_.region);
  // not in the call: the points would stay in memory during the fits
  Eigen::Matrix3d object_rotation = Eigen::Matrix3d::Identity();
  if (options_.fit == FitMode::PAPER && options_.pca == PcaScope::OBJECT)
    object_rotation = principalAxes(gather(object_));
  const std::vector<PartFit> fits = pcl_sq::fitParts(
      regions,
      object_rotation,
      [&](std::size_t part) { return gather(clusters_[part].indices); },
      options_,
      threads_);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    PartReport part;
    part.indices = std::move(clusters_[i]);
    part.indices.header = input_.header;
    part.fit = fits[i].summary;
    part.fit_ms = fits[i].milliseconds;
    if (part.fit.ok()) {
      part.model_part = static_cast<int>(model.size());
      model.parts.push_back(part.fit.model);
    }
    report_.parts.push_back(std::move(part));
  }
  if (!model.empty()) {
    if (const std::size_t left = fits.size() - model.size(); left > 0)
      report_.notes.push_back(std::to_string(left) + " of " +
                              std::to_string(fits.size()) +
                              " prisms span no volume and gave no superquadric; their "
                              "points are in none: fewer divisions hold more points");
    return true;
  }
  return fail(std::to_string(object_.size()) +
              " points give no superquadric: at least ten "
              "are needed, and they must span a volume; give points of more than one "
              "side of the object");
}

} // namespace pcl_sq::detail
