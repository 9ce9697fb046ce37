// SPDX-License-Identifier: BSD-3-Clause
// The default way: what one view tells of an object, and as many superquadrics as the
// data ask for.
#include "elements/surface_estimator.h"

#include <algorithm>

namespace pcl_sq::detail {

bool SurfaceEstimator::estimateParts(MultiSuperquadric& model) {
  return run("crop", [&] { return crop(); }) &&
         // the whole view, not the region's points alone: outline, table, free space
         run("observe", [&] { return observe(); }) &&
         run("fit", [&] { return fitObject(model); }) &&
         run("evaluate", [&] { return evaluate(model); }) &&
         run("grasp_points", [&] { return findGraspPoints(model); });
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

} // namespace pcl_sq::detail
