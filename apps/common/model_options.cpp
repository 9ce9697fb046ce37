// SPDX-License-Identifier: BSD-3-Clause
#include "model_options.h"

#include "app.h"
#include "files.h"

#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/stage_timer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace pcl_sq::app {

namespace {

/** \brief An option that takes one of some names. */
template <typename Enum>
CLI::Option* addChoice(CLI::App& cli,
                       const std::string& name,
                       Enum& value,
                       const std::map<std::string, Enum>& names,
                       const std::string& description) {
  std::string list, current;
  for (const auto& [key, choice] : names) {
    list += (list.empty() ? "" : "|") + key;
    if (choice == value)
      current = key;
  }
  return cli
      .add_option_function<std::string>(
          name,
          [&value, names](const std::string& key) { value = names.at(key); },
          description)
      ->type_name(list)
      ->default_str(current)
      ->check(CLI::Validator(
          [names, list](const std::string& key) {
            return names.count(key) ? std::string()
                                    : "'" + key + "' is none of " + list;
          },
          ""));
}

void addFitOptions(CLI::App& cli, EstimationOptions& options) {
  addChoice<Decomposition>(
      cli,
      "--decomposition",
      options.decomposition,
      {{"none", Decomposition::NONE},
       {"prisms", Decomposition::PRISMS},
       {"parts", Decomposition::PARTS}},
      "One superquadric, one per prism of voxels, or as many as the data ask for");
  addChoice<FitMode>(
      cli,
      "--fit",
      options.fit,
      {{"paper", FitMode::PAPER}, {"full", FitMode::FULL}},
      "The paper's three parameters, or all eleven; full is the default of "
      "--decomposition none");
  PaperFitOptions& fit = options.paper_fit;
  addChoice<Cost>(
      cli,
      "--cost",
      fit.cost,
      {{"paper", Cost::PAPER}, {"solina", Cost::SOLINA}, {"radial", Cost::RADIAL}},
      "What the paper's fit minimises");
  addChoice<AxisAssignment>(
      cli,
      "--axis-assignment",
      fit.axis_assignment,
      {{"depth", AxisAssignment::DEPTH}, {"best_of_3", AxisAssignment::BEST_OF_3}},
      "Axis of epsilon1: the depth, or the best of three");
  addChoice<Extents>(
      cli,
      "--extents",
      fit.extents,
      {{"extremes", Extents::EXTREMES}, {"quantiles", Extents::QUANTILES}},
      "Width and height from the outermost points or from quantiles");
  addChoice<PcaScope>(cli,
                      "--pca",
                      options.pca,
                      {{"object", PcaScope::OBJECT}, {"part", PcaScope::PART}},
                      "One rotation for all parts, or one for each");
  addChoice<CenterRule>(
      cli,
      "--center",
      options.center,
      {{"front", CenterRule::FRONT},
       {"region", CenterRule::REGION},
       {"mean", CenterRule::MEAN}},
      "A part's points keep their front, or the centre is the region's or theirs");
}

void addPrismOptions(CLI::App& cli, EstimationOptions& options) {
  VoxelOptions& voxels = options.voxels;
  cli.add_option_function<std::vector<double>>(
         "--voxel-percent",
         [&voxels](const std::vector<double>& percent) {
           voxels.rule = VoxelRule::PERCENT;
           voxels.percent = Eigen::Vector3d(percent[0], percent[1], percent[2]);
         },
         "Voxel sides in percent of the region's sides")
      ->expected(3)
      ->delimiter(',')
      ->type_name("X,Y,Z")
      ->default_str("5,5,10");
  cli.add_option_function<double>(
         "--voxel-size",
         [&voxels](double size) {
           voxels.rule = VoxelRule::TARGET_SIZE_CLAMPED;
           voxels.target_size = size;
         },
         "Voxel side [m], divisions kept within 10 and 31")
      ->type_name("M")
      ->check(CLI::PositiveNumber);
  cli.add_option_function<std::vector<int>>(
         "--divisions",
         [&voxels](const std::vector<int>& n) {
           voxels.rule = VoxelRule::DIVISIONS;
           voxels.divisions = Eigen::Vector3i(n[0], n[1], n[2]);
         },
         "Numbers of voxels themselves")
      ->expected(3)
      ->delimiter(',')
      ->type_name("NX,NY,NZ");
  addChoice<PrismRun>(
      cli,
      "--run",
      options.prisms.run,
      {{"cross", PrismRun::CROSS}, {"min", PrismRun::MIN}, {"max", PrismRun::MAX}},
      "How far a prism extends down (the paper's Fig. 4)");
  cli.add_flag("--exclusive",
               options.exclusive_points,
               "A point counts for its smallest prism only");
}

std::string optionsToJson(const ModelOptions& options) {
  nlohmann::ordered_json json;
  const EstimationOptions& e = options.estimation;
  json["decomposition"] = e.decomposition == Decomposition::NONE     ? "none"
                          : e.decomposition == Decomposition::PRISMS ? "prisms"
                                                                     : "parts";
  if (e.decomposition == Decomposition::PARTS) {
    json["parts"] = e.object_fit.parts;
    json["max_parts"] = e.object_fit.max_parts;
    if (!options.mask.empty())
      json["mask"] = options.mask;
    return json.dump();
  }
  json["fit"] = e.fit == FitMode::PAPER ? "paper" : "full";
  json["cost"] = e.paper_fit.cost == Cost::PAPER    ? "paper"
                 : e.paper_fit.cost == Cost::SOLINA ? "solina"
                                                    : "radial";
  json["axis_assignment"] =
      e.paper_fit.axis_assignment == AxisAssignment::DEPTH ? "depth" : "best_of_3";
  json["extents"] = e.paper_fit.extents == Extents::EXTREMES ? "extremes" : "quantiles";
  json["pca"] = e.pca == PcaScope::OBJECT ? "object" : "part";
  json["center"] = e.center == CenterRule::FRONT    ? "front"
                   : e.center == CenterRule::REGION ? "region"
                                                    : "mean";
  json["exclusive"] = e.exclusive_points;
  json["remove_plane"] = options.remove_plane;
  if (options.taper)
    json["taper"] = true;
  if (!options.roi.empty())
    json["roi"] = options.roi;
  if (!options.box.empty())
    json["box"] = options.box;
  return json.dump();
}

nlohmann::ordered_json boxToJson(const RoiBox& box) {
  return {{"min", {box.min.x(), box.min.y(), box.min.z()}},
          {"max", {box.max.x(), box.max.y(), box.max.z()}}};
}

/** \brief What the estimation saw and did, for the model file. */
std::string reportToJson(const ModelResult& result) {
  const EstimationReport& report = result.report;
  nlohmann::ordered_json json;
  const auto numbers = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json{v.x(), v.y(), v.z()};
  };
  if (result.up)
    json["up"] = numbers(*result.up);
  if (result.sensor)
    json["sensor"] = numbers(*result.sensor);
  json["region"] = boxToJson(report.region);
  json["region_points"] = report.region_points;
  json["voxels"] = {report.voxels.divisions.x(),
                    report.voxels.divisions.y(),
                    report.voxels.divisions.z()};
  json["parts"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < report.parts.size(); ++i) {
    const PartReport& part = report.parts[i];
    nlohmann::ordered_json entry = {{"points", part.indices.indices.size()},
                                    {"superquadric", part.model_part},
                                    {"iterations", part.fit.iterations},
                                    {"termination", toString(part.fit.termination)},
                                    {"fit_ms", part.fit_ms}};
    if (report.view.points.cols() > 0) {
      entry["shape"] = toString(part.shape.shape);
      entry["upright"] = part.shape.upright;
      entry["on_axis"] = part.shape.on_axis;
      entry["margin"] = part.margin;
      entry["noise"] = part.fit.sigma;
    }
    if (i < report.prisms.size())
      entry["prism"] = boxToJson(report.prisms[i].box);
    json["parts"].push_back(entry);
  }
  if (report.view.points.cols() > 0) {
    json["outline"] = toString(report.view.outline);
    if (report.view.table) {
      const TableModel& t = *report.view.table;
      json["table"] = {t.normal.x(), t.normal.y(), t.normal.z(), t.offset};
    }
    json["notes"] = report.view.notes;
  }
  if (result.taper)
    json["taper"] = {
        {"margin", result.taper->margin},
        {"deviations", {result.taper->kx_deviation, result.taper->ky_deviation}}};
  json["grasp_points"] = report.grasp_indices.size();
  return nlohmann::ordered_json{{"report", json}}.dump();
}

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

void addModelOptions(CLI::App& cli, ModelOptions& options) {
  cli.set_config("--config", "", "TOML file with options; the command line wins")
      ->check(CLI::ExistingFile);
  cli.add_option("-o,--output", options.output, "Model as JSON")->type_name("FILE");
  addViewOptions(cli, options);
  addFitOptions(cli, options.estimation);
  cli.add_option("--roi", options.roi, "Object in the image [px] (organized clouds)")
      ->expected(4)
      ->delimiter(',')
      ->type_name("X,Y,W,H");
  cli.add_option(
         "--box", options.box, "Object's box: minx,miny,minz,maxx,maxy,maxz [m]")
      ->expected(6)
      ->delimiter(',')
      ->type_name("BOX");
  cli.add_flag("--remove-plane",
               options.remove_plane,
               "Keep the largest cluster above the largest plane");
  addPrismOptions(cli, options.estimation);
  cli.add_option("--grasp-points", options.grasp_points, "Points on the surface as PCD")
      ->type_name("FILE");
  cli.add_option("--grasp-threshold",
                 options.estimation.grasp_threshold,
                 "Largest |F^(e1/2) - 1| of such a point")
      ->capture_default_str();
  cli.add_option("--threads", options.threads, "Number of threads, 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
#ifdef PCL_SQ_HAVE_VISUALIZATION
  cli.add_option("--mesh", options.mesh, "Surface as .ply, .obj, .stl or .vtp")
      ->type_name("FILE");
  cli.add_option("--snapshot", options.snapshot, "Picture as PNG")->type_name("FILE");
#endif
}

void checkModelOptions(const ModelOptions& options) {
  std::string why;
  if (!options.estimation.isValid(&why))
    throw UsageError(why);
  if (!options.roi.empty() && (options.roi[2] <= 0 || options.roi[3] <= 0))
    throw UsageError("--roi needs a positive width and height");
  for (std::size_t k = 0; k + 3 < options.box.size(); ++k)
    if (!(options.box[k] < options.box[k + 3]))
      throw UsageError("--box needs each minimum below its maximum");
  checkTaper(options);
  for (const std::string& path :
       {options.output, options.mesh, options.grasp_points, options.snapshot})
    if (!path.empty())
      checkWritable(path);
}

ModelResult makeModel(const LoadedCloud& input,
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
  file.options_json = optionsToJson(options);
  timings.insert(
      timings.end(), result.report.timings_ms.begin(), result.report.timings_ms.end());
  if (options.taper)
    timer.run("taper", [&] { return addTaper(input, options, result); });
  double total = 0.0;
  for (const auto& [stage, ms] : timings)
    total += ms;
  timings.emplace_back("total", total);
  file.extra_json = reportToJson(result);
  return result;
}

} // namespace pcl_sq::app
