// SPDX-License-Identifier: BSD-3-Clause
// From a loaded cloud and the options to the model.
#include "app.h"
#include "model_json.h"

#include "pcl_sq/roi_estimator.h"
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
  std::optional<TablePlane> table; ///< where the plane was removed
};

pcl::IndicesPtr pointsInImage(const pcl::PointCloud<Point>& cloud,
                              const PixelRect& rect) {
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

/** \brief II-B: the aperture of the region in the image, or the object on the table. */
Selection chooseObject(const LoadedCloud& input, const ModelOptions& options) {
  const auto& cloud = *input.cloud;
  Selection selection;
  PixelRect rect;
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
    tabletop.setOptions(options.tabletop);
    tabletop.setInputCloud(input.cloud);
    if (!rect.empty())
      tabletop.setCandidates(pointsInImage(cloud, rect));
    if (!tabletop.segment(*selection.indices))
      throw Failure(tabletop.getFailure() + ".");
    selection.table = tabletop.getPlane();
  } else if (!rect.empty()) {
    RoiEstimator<Point> estimator;
    estimator.setInputCloud(input.cloud);
    estimator.setRect(rect);
    selection.has_region = true;
    if (!estimator.estimate(selection.region, *selection.indices))
      throw Failure("the --roi holds no cluster of points at one depth.");
  } else {
    selection.indices->resize(cloud.size());
    std::iota(selection.indices->begin(), selection.indices->end(), 0);
  }
  if (!options.box.empty()) {
    selection.has_region = true;
    selection.region.min =
        Eigen::Vector3d(options.box[0], options.box[1], options.box[2]);
    selection.region.max =
        Eigen::Vector3d(options.box[3], options.box[4], options.box[5]);
  }
  return selection;
}

} // namespace

ModelResult makeNearModel(const LoadedCloud& input,
                          const std::string& input_path,
                          const ModelOptions& options,
                          double load_ms) {
  ModelResult result;
  auto& timings = result.file.timings_ms;
  timings.emplace_back("load", load_ms);
  StageTimer timer(timings);
  const Selection selection =
      timer.run("object", [&] { return chooseObject(input, options); });
  ObjectSurfaceEstimation<Point> estimation;
  estimation.setInputCloud(input.cloud);
  estimation.setIndices(selection.indices);
  EstimationOptions settings = options.estimation;
  settings.view = makeView(options);
  settings.object_fit.fit.taper = options.taper;
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
  if (selection.table)
    result.up = selection.table->normal;
  else if (result.report.view.table)
    result.up = result.report.view.table->normal;
  if (result.report.view.hasCamera())
    result.sensor = result.report.view.camera.center;
  else if (input.cloud->isOrganized()) // an image of points
    result.sensor = input.cloud->sensor_origin_.head<3>().cast<double>();

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
  timings.insert(
      timings.end(), result.report.timings_ms.begin(), result.report.timings_ms.end());
  if (options.taper)
    timer.run("taper", [&] { return addTaper(input, options, result); });
  double total = 0.0;
  for (const auto& [stage, ms] : timings)
    total += ms;
  timings.emplace_back("total", total);
  return result;
}

} // namespace pcl_sq::app
