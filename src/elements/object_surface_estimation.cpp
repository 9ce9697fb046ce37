// SPDX-License-Identifier: BSD-3-Clause
// The beginning and the end of both ways from points to a model.
#include "elements/surface_estimator.h"
#include "parts/verdict.h"
#include "pcl_sq/impl/grasp_point_filter.hpp"
#include "union/surface_statistics.h"

namespace pcl_sq::detail {

namespace {

bool fail(const std::string& sentence, EstimationReport& report) {
  report.failure = sentence;
  PCL_WARN("[pcl_sq::ObjectSurfaceEstimation::estimate] %s.\n", sentence.c_str());
  return false;
}

} // namespace

bool SurfaceEstimator::fail(const std::string& sentence) {
  return detail::fail(sentence, report_);
}

Eigen::Matrix3Xf SurfaceEstimator::gather(const pcl::Indices& indices) const {
  Eigen::Matrix3Xf points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = input_.points.col(indices[i]);
  return points;
}

bool SurfaceEstimator::estimate(MultiSuperquadric& model) {
  return options_.decomposition == Decomposition::PARTS ? estimateParts(model)
                                                        : estimatePrisms(model);
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
    return fail(input_.region ? "no finite point lies in the region; check the box "
                                "against the cloud's extent"
                : input_.indices.empty()
                    ? "there are no points; give a cloud, and indices, that hold some"
                    : "none of the points is finite; give others");
  constexpr double FARTHEST = 1e7; // [m]; beyond, single precision has no shape left
  if (box.min().minCoeff() < -FARTHEST || box.max().maxCoeff() > FARTHEST)
    return fail("the region reaches farther than 1e7 m; remove the outliers or set a "
                "region");
  report_.region.min = box.min();
  report_.region.max = box.max();
  return true;
}

void SurfaceEstimator::dropStrays(const MultiSuperquadric& model, double noise) {
  const double limit = farthestOnSurface(report_.view, noise);
  pcl::Indices near;
  const std::vector<double> distances = smallestResiduals(
      model, gather(object_).cast<double>(), kernels::Residual::FOOT_POINT);
  for (std::size_t k = 0; k < object_.size(); ++k)
    if (std::abs(distances[k]) <= limit)
      near.push_back(object_[k]);
  const std::size_t strays = object_.size() - near.size();
  if (near.empty() || 20 * strays < object_.size()) {
    if (!near.empty())
      object_ = std::move(near);
    return;
  }
  report_.notes.push_back(std::to_string(100 * strays / object_.size()) +
                          " % of the object's points lie far off the model and are "
                          "left out of its figures: "
                          "false matches, or what it does not show");
  object_ = std::move(near);
}

bool SurfaceEstimator::evaluate(MultiSuperquadric& model) {
  const bool parts = options_.decomposition == Decomposition::PARTS;
  for (const Superquadric& part : model.parts)
    if (std::string why; !part.isValid(&why)) { // such as sizes of 1e-30
      model = {};
      return fail("the points give no superquadric that can be used: " + why);
    }
  double noise = 0.0;
  for (const PartReport& part : report_.parts)
    noise = std::max(noise, part.fit.sigma);
  if (parts && report_.view.hasCamera())
    dropStrays(model, noise);
  report_.object_indices = object_;
  const SurfaceStatistics statistics = model.statistics(gather(object_));
  report_.distortion = statistics.distortion;
  report_.rms_distance = statistics.rms_distance;
  if (!parts)
    return true;
  const Verdict verdict = judge(model, report_.view, noise);
  report_.confidence = verdict.confidence();
  const std::string objection = verdict.objection();
  // a number of parts that is asked for is the user's own choice
  if (objection.empty() || options_.object_fit.parts > 0)
    return true;
  model = {};
  return fail(objection);
}

bool SurfaceEstimator::findGraspPoints(const MultiSuperquadric& model) {
  pcl::Indices removed;
  selectOnSurface(model,
                  input_.points,
                  object_,
                  SurfaceMetric::GAUGE,
                  options_.grasp_threshold,
                  report_.grasp_indices,
                  removed);
  return true;
}

bool estimateSurface(const EstimationInput* input,
                     const EstimationOptions& options,
                     unsigned int threads,
                     MultiSuperquadric& model,
                     EstimationReport& report) {
  model = {};
  report = {};
  if (!input)
    return fail("there is no input cloud; call setInputCloud first", report);
  if (const char* why =
          contradictionOf(static_cast<std::size_t>(input->points.cols()),
                          static_cast<std::size_t>(std::max(0, input->width)),
                          static_cast<std::size_t>(std::max(0, input->height)),
                          input->indices))
    return fail(why, report);
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
