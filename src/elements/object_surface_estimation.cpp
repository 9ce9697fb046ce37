// SPDX-License-Identifier: BSD-3-Clause
// The paper in one function, and the steps that are not elsewhere.
#include "pcl_sq/impl/object_surface_estimation.hpp"
#include "pcl_sq/impl/for_each_voxel.hpp"
#include "pcl_sq/impl/grasp_point_filter.hpp"
#include "pcl_sq/impl/prism_segmentation.hpp"

#include "pcl_sq/fit_parts.h"
#include "pcl_sq/stage_timer.h"

namespace pcl_sq::detail {

namespace {

bool fail(const std::string& sentence, EstimationReport& report) {
  report.failure = sentence;
  PCL_WARN("[pcl_sq::ObjectSurfaceEstimation::estimate] %s.\n", sentence.c_str());
  return false;
}

/** \brief One estimation: the input, the settings and what is found. */
class SurfaceEstimator {
public:
  SurfaceEstimator(const EstimationInput& input,
                   const EstimationOptions& options,
                   unsigned int threads,
                   EstimationReport& report)
      : input_(input), options_(options), threads_(threads), report_(report) {}

  bool estimate(MultiSuperquadric& model);

private:
  bool fail(const std::string& sentence) { return detail::fail(sentence, report_); }
  bool crop();
  bool observe();
  bool decompose();
  bool fitObject(MultiSuperquadric& model);
  bool fitParts(MultiSuperquadric& model);
  bool evaluate(MultiSuperquadric& model);
  void findGraspPoints(const MultiSuperquadric& model);

  /** \brief Points of the cloud as columns. */
  Eigen::Matrix3Xf gather(const pcl::Indices& indices) const {
    Eigen::Matrix3Xf points(3, static_cast<Eigen::Index>(indices.size()));
    for (std::size_t i = 0; i < indices.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)) = input_.points.col(indices[i]);
    return points;
  }

  const EstimationInput& input_;
  const EstimationOptions& options_;
  const unsigned int threads_;
  EstimationReport& report_;
  pcl::Indices object_;
  std::vector<pcl::PointIndices> clusters_;
};

bool SurfaceEstimator::estimate(MultiSuperquadric& model) {
  StageTimer timer(report_.timings_ms, options_.progress);
  // II-B: the points of the query region
  bool found = timer.run("crop", [&] { return crop(); });
  // the best mode looks at the whole view instead of the region's points alone
  const bool parts = options_.decomposition == Decomposition::PARTS;
  if (parts)
    found = found && timer.run("observe", [&] { return observe(); });
  // III-C, Figs. 3 and 4: voxels relative to the region, prisms of connected voxels
  found = found && (parts || timer.run("decompose", [&] { return decompose(); }));
  // III-B, Eqs. (4)-(7): one superquadric per prism; their union is the object
  found = found &&
          timer.run("fit", [&] { return parts ? fitObject(model) : fitParts(model); });
  found = found && timer.run("evaluate", [&] { return evaluate(model); });
  // III-C, end: the points on the union's surface are where a hand may touch
  if (found)
    timer.run("grasp_points", [&] {
      findGraspPoints(model);
      return true;
    });
  return found;
}

bool SurfaceEstimator::crop() {
  Eigen::AlignedBox3d box;
  for (const auto index : input_.indices) {
    const Eigen::Vector3f point = input_.points.col(index);
    const Eigen::Vector3d p = point.cast<double>();
    if (!point.allFinite() || (input_.region && !input_.region->contains(p)))
      continue;
    object_.push_back(index);
    box.extend(p);
  }
  if (input_.region)
    box = Eigen::AlignedBox3d(input_.region->min, input_.region->max);
  report_.region_points = object_.size();
  if (object_.empty())
    return fail("no finite point lies in the region; check the box against the cloud's "
                "extent");
  constexpr double FARTHEST = 1e7; // [m]; beyond, single precision has no shape left
  if (box.min().minCoeff() < -FARTHEST || box.max().maxCoeff() > FARTHEST)
    return fail("the region reaches farther than 1e7 m; remove the outliers or set a "
                "region");
  report_.region.min = box.min();
  report_.region.max = box.max();
  return true;
}

bool SurfaceEstimator::observe() {
  ViewOptions view = options_.view;
  if (!view.viewpoint && input_.sensor_origin.norm() > 0.0)
    view.viewpoint = input_.sensor_origin;
  view.object_is_region = input_.region.has_value();
  // without a choice the object is still to be found among the points
  std::vector<int> columns;
  if (input_.region || input_.chosen)
    columns.assign(object_.begin(), object_.end());
  std::string why;
  if (!observeObject(input_.points,
                     input_.width,
                     input_.height,
                     columns,
                     view,
                     report_.view,
                     &why))
    return fail(why);
  report_.notes = report_.view.notes;
  report_.region.min = report_.view.points.rowwise().minCoeff();
  report_.region.max = report_.view.points.rowwise().maxCoeff();
  if (!report_.view.pixels.cells.empty()) {
    // all the object's pixels but those whose match went elsewhere
    const Eigen::Vector3d margin =
        Eigen::Vector3d::Constant(0.25 * report_.view.extent);
    const Eigen::AlignedBox3d box(report_.region.min - margin,
                                  report_.region.max + margin);
    object_.clear();
    for (Eigen::Index i = 0; i < input_.points.cols(); ++i)
      if (report_.view.pixels.cells[static_cast<std::size_t>(i)] &&
          box.contains(input_.points.col(i).cast<double>()))
        object_.push_back(static_cast<pcl::index_t>(i));
  }
  report_.region_points = object_.size();
  return true;
}

bool SurfaceEstimator::fitObject(MultiSuperquadric& model) {
  ObjectFitOptions options = options_.object_fit;
  options.fit.threads = threads_;
  ObjectFit fit = pcl_sq::fitObject(report_.view, options);
  if (fit.model.empty())
    return fail(std::to_string(report_.view.points.cols()) +
                " points give no superquadric: they must span a volume; give points of "
                "more than one side of the object");
  model = fit.model;
  if (const int wanted = options.parts; int(model.size()) < wanted)
    report_.notes.push_back(std::to_string(wanted) +
                            " parts were asked for, but the "
                            "points could be cut into " +
                            std::to_string(model.size()) + " only");
  report_.parts.resize(fit.parts.size());
  for (std::size_t k = 0; k < fit.parts.size(); ++k) {
    PartReport& part = report_.parts[k];
    part.indices.header = input_.header;
    part.fit = fit.parts[k].fit;
    part.shape = fit.parts[k].chosen;
    part.margin = fit.parts[k].margin;
    part.model_part = static_cast<int>(k);
    for (std::size_t i = 0; i < fit.labels.size(); ++i)
      if (fit.labels[i] == static_cast<int>(k))
        part.indices.indices.push_back(report_.view.columns[i]);
    std::sort(part.indices.indices.begin(), part.indices.indices.end());
  }
  return true;
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

bool SurfaceEstimator::fitParts(MultiSuperquadric& model) {
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

bool SurfaceEstimator::evaluate(MultiSuperquadric& model) {
  report_.object_indices = object_;
  const Eigen::Matrix3Xf points = gather(object_);
  const SurfaceStatistics statistics = model.statistics(points);
  report_.distortion = statistics.distortion;
  report_.rms_distance = statistics.rms_distance;
  // Even the ball that fits a cube best lies within .08 of the cube's side: what lies
  // farther off, in the mean, is no surface of the model that was found. A number of
  // parts that is asked for is the user's own choice.
  constexpr double FARTHEST = 0.1;
  const double longest = model.boundingBox().sizes().maxCoeff();
  const bool found_freely =
      options_.decomposition == Decomposition::PARTS && options_.object_fit.parts == 0;
  if (!found_freely || !(statistics.rms_distance > FARTHEST * longest))
    return true;
  model = {};
  return fail("the object's points lie too far from any model of it, by more than a "
              "tenth of its size: they are no one thing, or noise; give the object's "
              "region or mask, or more texture to a stereo pair");
}

void SurfaceEstimator::findGraspPoints(const MultiSuperquadric& model) {
  pcl::Indices removed;
  selectOnSurface(model,
                  input_.points,
                  object_,
                  SurfaceMetric::GAUGE,
                  options_.grasp_threshold,
                  report_.grasp_indices,
                  removed);
}

} // namespace

bool estimateSurface(const EstimationInput* input,
                     const EstimationOptions& options,
                     unsigned int threads,
                     MultiSuperquadric& model,
                     EstimationReport& report) {
  model = {};
  report = {};
  if (!input)
    return fail("there is no input cloud; call setInputCloud first", report);
  return SurfaceEstimator(*input, options, threads, report).estimate(model);
}

void setOptions(const EstimationOptions& options, EstimationOptions& target) {
  std::string why;
  if (options.isValid(&why))
    target = options;
  else
    PCL_ERROR("[pcl_sq::ObjectSurfaceEstimation::setOptions] %s; the options stay as "
              "they were.\n",
              why.c_str());
}

} // namespace pcl_sq::detail
