// SPDX-License-Identifier: BSD-3-Clause
// From a loaded cloud and the options to the model.
#include "command_line/app.h"
#include "model/model_json.h"

#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/scene_estimation.h"
#include "pcl_sq/stage_timer.h"

#include <algorithm>
#include <numeric>

namespace pcl_sq::app {
namespace {

using Point = pcl::PointXYZRGBA;

/** \brief The points that the options point at, and their box where they name one. */
struct Selection {
  pcl::IndicesPtr indices = pcl::make_shared<pcl::Indices>();
  bool has_region = false;
  RoiBox region;
  std::optional<TableModel> table; ///< where the plane was removed
};

pcl::IndicesPtr pointsInImage(const pcl::PointCloud<Point>& cloud,
                              const CellRect& rect) {
  auto indices = pcl::make_shared<pcl::Indices>();
  for (int y = std::max(rect.y, 0);
       y < std::min(rect.y + rect.height, int(cloud.height));
       ++y)
    for (int x = std::max(rect.x, 0);
         x < std::min(rect.x + rect.width, int(cloud.width));
         ++x)
      indices->push_back(y * int(cloud.width) + x);
  return indices;
}

RoiBox boxOf(const ModelOptions& options) {
  RoiBox box;
  box.min = Eigen::Vector3d(options.box[0], options.box[1], options.box[2]);
  box.max = Eigen::Vector3d(options.box[3], options.box[4], options.box[5]);
  return box;
}

pcl::IndicesPtr pointsInBox(const pcl::PointCloud<Point>& cloud, const RoiBox& box) {
  auto indices = pcl::make_shared<pcl::Indices>();
  const Eigen::AlignedBox3d aligned(box.min, box.max);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (aligned.contains(cloud[i].getVector3fMap().cast<double>()))
      indices->push_back(static_cast<pcl::index_t>(i));
  return indices;
}

/** \brief II-B: the region's points at one depth and their box. Depth is along the
 * camera's axis, whatever frame the cloud is in. */
bool openAperture(const LoadedCloud& input,
                  const ModelOptions& options,
                  const CellRect& rect,
                  Selection& selection) {
  RoiEstimator<Point> estimator;
  estimator.setRect(rect);
  std::optional<Eigen::Vector3d> viewpoint = options.frame.viewpointOf();
  if (!viewpoint)
    viewpoint = viewpointOf(input);
  PinholeCamera camera;
  const bool moved = findCamera(coordinatesOf(input),
                                static_cast<int>(input.cloud->width),
                                static_cast<int>(input.cloud->height),
                                viewpoint,
                                camera) &&
                     !(camera.center.isZero() && camera.rotation.isIdentity());
  if (!moved) {
    estimator.setInputCloud(input.cloud);
    return estimator.estimate(selection.region, *selection.indices);
  }
  auto seen = pcl::make_shared<pcl::PointCloud<Point>>(*input.cloud);
  for (Point& p : *seen)
    p.getVector3fMap() = (camera.rotation.transpose() *
                          (p.getVector3fMap().cast<double>() - camera.center))
                             .cast<float>();
  estimator.setInputCloud(seen);
  if (!estimator.estimate(selection.region, *selection.indices))
    return false;
  Eigen::AlignedBox3d box;
  for (const auto index : *selection.indices)
    box.extend((*input.cloud)[index].getVector3fMap().cast<double>());
  selection.region.min = box.min();
  selection.region.max = box.max();
  return true;
}

/** \brief II-B: the aperture of the region in the image, or the object on the table. */
Selection chooseObject(const LoadedCloud& input, const ModelOptions& options) {
  const auto& cloud = *input.cloud;
  Selection selection;
  CellRect rect;
  if (!options.roi.empty()) {
    rect = {options.roi[0], options.roi[1], options.roi[2], options.roi[3]};
    if (!cloud.isOrganized())
      throw Failure("--roi needs an organized cloud (an image of points); use --box.");
    if (pointsInImage(cloud, rect)->empty())
      throw Failure("the --roi lies outside of the image of " +
                    std::to_string(cloud.width) + " x " + std::to_string(cloud.height) +
                    " pixels.");
  }
  if (options.remove_plane) {
    TabletopSegmentation<Point> tabletop;
    TabletopOptions settings;
    settings.viewpoint = options.frame.viewpointOf();
    settings.up = options.frame.upOf();
    settings.table = options.frame.tableOf();
    tabletop.setOptions(settings);
    tabletop.setInputCloud(input.cloud);
    if (!rect.empty())
      tabletop.setCandidates(pointsInImage(cloud, rect));
    else if (!options.box.empty())
      tabletop.setCandidates(pointsInBox(cloud, boxOf(options)));
    if (!tabletop.segment(*selection.indices))
      throw Failure(tabletop.getFailure() + ".");
    selection.table = tabletop.getTable();
    return selection;
  }
  if (!rect.empty()) {
    selection.has_region = true;
    if (!openAperture(input, options, rect, selection))
      throw Failure(
          "the --roi holds no cluster of points at one depth; draw it around the "
          "object, where the cloud has points.");
  } else {
    selection.indices->resize(cloud.size());
    std::iota(selection.indices->begin(), selection.indices->end(), 0);
  }
  if (!options.box.empty()) {
    selection.has_region = true;
    selection.region = boxOf(options);
  }
  return selection;
}

} // namespace

void tellFrame(const LoadedCloud& input,
               const ModelOptions& options,
               const std::optional<TableModel>& removed,
               ModelResult& result) {
  const ObservedObject& view = result.report.view;
  const std::optional<TableModel>& table = removed ? removed : view.table;
  if (table) {
    const Eigen::Vector3d& n = table->normal;
    result.file.table = {n.x(), n.y(), n.z(), table->offset};
    result.up = n;
  }
  if (const auto up = options.frame.upOf())
    result.up = up->normalized();
  if (view.hasCamera()) {
    result.sensor = view.camera.center;
    result.sensor_known = view.viewpoint_known;
  } else {
    result.sensor = options.frame.viewpointOf();
    if (!result.sensor)
      result.sensor = viewpointOf(input);
    result.sensor_known = result.sensor.has_value();
  }
}

void tellModel(const LoadedCloud& input,
               const std::string& input_path,
               const MultiSuperquadric& model,
               ModelResult& result) {
  ModelFile& file = result.file;
  file.model = model;
  for (const PartReport& part : result.report.parts)
    if (part.model_part >= 0)
      file.statistics.push_back({part.fit.points,
                                 part.fit.distortion,
                                 part.fit.rms_distance,
                                 toString(part.fit.termination)});
  file.distortion = result.report.distortion;
  file.rms_distance = result.report.rms_distance;
  file.frame = input.cloud->header.frame_id;
  file.input_path = input_path;
  file.input_points = input.cloud->size();
  file.finite_points = input.finite_points;
}

namespace {

/** \brief Says when what was fitted as one object looks like several. */
void noteSeveralThings(const LoadedCloud& input, ModelResult& result) {
  const int things = detail::countThings(
      result.report.view,
      coordinatesOf(input),
      input.has_color ? detail::colorsOf(*input.cloud) : detail::ColorMatrix());
  if (things > 1)
    result.report.notes.push_back("the object looks like " + std::to_string(things) +
                                  " things; pcl_sq_scene tells them apart, a tighter "
                                  "region or a mask chooses one");
}

} // namespace

ModelResult makeNearModel(const LoadedCloud& input,
                          const std::string& input_path,
                          const ModelOptions& options,
                          double load_ms) {
  ModelResult result;
  auto& timings = result.file.timings_ms;
  timings.emplace_back("load", load_ms);
  StageTimer timer(timings, options.estimation.progress);
  const Selection selection =
      timer.run("object", [&] { return chooseObject(input, options); });
  ObjectSurfaceEstimation<Point> estimation;
  estimation.setInputCloud(input.cloud);
  if (selection.indices->size() < input.cloud->size())
    estimation.setIndices(selection.indices);
  EstimationOptions settings = options.estimation;
  settings.view = makeView(options);
  if (selection.table)
    settings.view.table = selection.table;
  settings.object_fit.fit.taper = options.taper.value_or(true);
  std::string why;
  if (!settings.isValid(&why))
    throw Failure(why + ".");
  estimation.setOptions(settings);
  estimation.setNumberOfThreads(options.threads);
  if (selection.has_region)
    estimation.setRegion(selection.region);
  MultiSuperquadric model;
  const bool found = estimation.estimate(model);
  result.report = estimation.getReport();
  if (!found)
    throw Failure(result.report.failure + ".");
  result.object = *selection.indices;
  noteSeveralThings(input, result);
  result.report.notes.insert(
      result.report.notes.begin(), input.notes.begin(), input.notes.end());
  tellFrame(input, options, selection.table, result);
  tellModel(input, input_path, model, result);
  timings.insert(
      timings.end(), result.report.timings_ms.begin(), result.report.timings_ms.end());
  if (options.taper.value_or(false))
    timer.run("taper", [&] { return addTaper(input, options, result); });
  double total = 0.0;
  for (const auto& [stage, ms] : timings)
    total += ms;
  timings.emplace_back("total", total);
  return result;
}

} // namespace pcl_sq::app
