// SPDX-License-Identifier: BSD-3-Clause
// --taper: bodies whose section grows along their axis, where the data demand it.
#include "command_line/app.h"
#include "options/model_options.h"

namespace pcl_sq::app {

namespace {

Eigen::Matrix3Xd pointsAt(const LoadedCloud& input, const pcl::Indices& indices) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        (*input.cloud)[std::size_t(indices[i])].getVector3fMap().cast<double>();
  return points;
}

} // namespace

void addTaperOption(CLI::App& cli, ModelOptions& options) {
  cli.add_flag_function(
      "--taper,!--no-taper",
      [&options](std::int64_t count) { options.taper = count > 0; },
      "Let sections grow along the axis (Solina & Bajcsy 1990) where the data demand "
      "it; "
      "the default with --decomposition parts, possible with none; --no-taper: never");
}

void checkTaper(const ModelOptions& options) {
  if (!options.taper.value_or(false))
    return;
  const EstimationOptions& e = options.estimation;
  const bool one = e.decomposition == Decomposition::NONE && e.fit == FitMode::FULL;
  if (!one && e.decomposition != Decomposition::PARTS)
    throw UsageError("--taper needs --decomposition parts, or none with --fit full.");
}

bool addTaper(const LoadedCloud& input,
              const ModelOptions& options,
              ModelResult& result) {
  if (options.estimation.decomposition != Decomposition::NONE)
    return false;
  const Eigen::Matrix3Xd points =
      pointsAt(input, result.report.parts.at(0).indices.indices);
  result.taper = fitTapered(points, options.estimation.full_fit);
  if (!result.taper->ok())
    throw Failure("the points allow no tapered fit; leave out --taper.");
  if (!result.taper->model.isTapered())
    return false;
  ModelFile& file = result.file;
  file.model.parts = {result.taper->model};
  file.distortion = file.statistics[0].distortion = file.model.distortion(points);
  file.rms_distance = file.statistics[0].rms_distance = file.model.rmsDistance(points);
  result.report.grasp_indices.clear();
  const pcl::Indices& indices = result.report.parts.at(0).indices.indices;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (std::abs(file.model.gauge(points.col(i)) - 1.0) <=
        options.estimation.grasp_threshold)
      result.report.grasp_indices.push_back(indices[std::size_t(i)]);
  return true;
}

} // namespace pcl_sq::app
