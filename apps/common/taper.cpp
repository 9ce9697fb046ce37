// SPDX-License-Identifier: BSD-3-Clause
// --taper: one superquadric whose section grows along its axis, where the points demand
// it. What cannot respect a taper is refused.
#include "app.h"
#include "model_options.h"

namespace pcl_sq::app {

namespace {

/** \brief D of Eq. (7) and the points within the threshold, with the tapered gauge. */
void measure(const Eigen::Matrix3Xd& points,
             const pcl::Indices& indices,
             double threshold,
             ModelResult& result) {
  const TaperedSuperquadric& model = result.taper->model;
  double sum = 0.0;
  result.report.grasp_indices.clear();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double off = model.gauge(points.col(i)) - 1.0;
    if (!std::isfinite(off))
      continue;
    sum += off * off;
    if (std::abs(off) <= threshold)
      result.report.grasp_indices.push_back(indices[std::size_t(i)]);
  }
  const double distortion =
      std::sqrt(model.shape.semi_axes.prod()) * sum / double(points.cols());
  const double rms = result.taper->rms_distance;
  result.file.distortion = result.file.statistics[0].distortion = distortion;
  result.file.rms_distance = result.file.statistics[0].rms_distance = rms;
}

} // namespace

void addTaperOption(CLI::App& cli, ModelOptions& options) {
  cli.add_flag("--taper",
               options.taper,
               "With --decomposition none: let the section grow along the axis (Solina "
               "& Bajcsy 1990) where the points demand it");
}

void checkTaper(const ModelOptions& options) {
  if (!options.taper)
    return;
  if (options.estimation.decomposition != Decomposition::NONE ||
      options.estimation.fit != FitMode::FULL)
    throw UsageError("--taper needs --decomposition none and --fit full.");
  if (!options.grasp_points.empty())
    throw UsageError("--grasp-points cannot respect a taper; leave --taper out.");
}

bool addTaper(const LoadedCloud& input,
              const ModelOptions& options,
              ModelResult& result) {
  const pcl::Indices& indices = result.report.parts.at(0).indices.indices;
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        (*input.cloud)[std::size_t(indices[i])].getVector3fMap().cast<double>();
  result.taper = fitTapered(points, options.estimation.full_fit);
  if (!result.taper->ok())
    throw Failure("the points allow no tapered fit (" +
                  std::string(toString(result.taper->untapered.termination)) + ").");
  const TaperedSuperquadric& model = result.taper->model;
  if (!model.isTapered())
    return false;
  result.file.model.parts[0] = model.shape;
  result.file.tapers = {{model.kx, model.ky}};
  measure(points, indices, options.estimation.grasp_threshold, result);
  return true;
}

} // namespace pcl_sq::app
