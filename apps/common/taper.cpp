// SPDX-License-Identifier: BSD-3-Clause
// --taper: parts whose section grows along their axis, where the data demand it. What
// cannot respect a taper is refused.
#include "app.h"
#include "model_options.h"

namespace pcl_sq::app {

namespace {

Eigen::Matrix3Xd pointsAt(const LoadedCloud& input, const pcl::Indices& indices) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        (*input.cloud)[std::size_t(indices[i])].getVector3fMap().cast<double>();
  return points;
}

/** \brief Writes the tapered parts into the model file and measures them. */
void replaceModel(const LoadedCloud& input,
                  const TaperedUnion& model,
                  double threshold,
                  ModelResult& result) {
  ModelFile& file = result.file;
  file.tapers.clear();
  for (std::size_t k = 0; k < model.size(); ++k) {
    file.model.parts[k] = model.parts[k].shape;
    file.tapers.push_back({model.parts[k].kx, model.parts[k].ky});
    TaperedUnion single;
    single.parts.push_back(model.parts[k]);
    const Eigen::Matrix3Xd own =
        pointsAt(input, result.report.parts[k].indices.indices);
    file.statistics[k].distortion = single.distortion(own);
    file.statistics[k].rms_distance = single.rmsDistance(own);
  }
  const pcl::Indices& indices = result.report.object_indices;
  const Eigen::Matrix3Xd points = pointsAt(input, indices);
  file.distortion = model.distortion(points);
  file.rms_distance = model.rmsDistance(points);
  result.report.grasp_indices.clear();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (std::abs(model.gauge(points.col(i)) - 1.0) <= threshold)
      result.report.grasp_indices.push_back(indices[std::size_t(i)]);
}

} // namespace

void addTaperOption(CLI::App& cli, ModelOptions& options) {
  cli.add_flag("--taper",
               options.taper,
               "Let sections grow along the axis (Solina & Bajcsy 1990) where the data "
               "demand it; with --decomposition parts or none");
}

void checkTaper(const ModelOptions& options) {
  if (!options.taper)
    return;
  const EstimationOptions& e = options.estimation;
  const bool one = e.decomposition == Decomposition::NONE && e.fit == FitMode::FULL;
  if (!one && e.decomposition != Decomposition::PARTS)
    throw UsageError("--taper needs --decomposition parts, or none with --fit full.");
  if (!options.grasp_points.empty())
    throw UsageError("--grasp-points cannot respect a taper; leave --taper out.");
}

bool addTaper(const LoadedCloud& input,
              const ModelOptions& options,
              ModelResult& result) {
  TaperedUnion model = result.report.tapered;
  if (options.estimation.decomposition == Decomposition::NONE) {
    result.taper =
        fitTapered(pointsAt(input, result.report.parts.at(0).indices.indices),
                   options.estimation.full_fit);
    if (!result.taper->ok())
      throw Failure("the points allow no tapered fit; leave out --taper.");
    model.parts = {result.taper->model};
  }
  if (!model.isTapered())
    return false;
  replaceModel(input, model, options.estimation.grasp_threshold, result);
  return true;
}

} // namespace pcl_sq::app
