// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_json.h"

#include "report/summary.h"

#include <nlohmann/json.hpp>

namespace pcl_sq::app {
namespace {

nlohmann::ordered_json boxToJson(const RoiBox& box) {
  return {{"min", {box.min.x(), box.min.y(), box.min.z()}},
          {"max", {box.max.x(), box.max.y(), box.max.z()}}};
}

} // namespace

std::string optionsToJson(const ModelOptions& options) {
  nlohmann::ordered_json json;
  const EstimationOptions& e = options.estimation;
  json["decomposition"] = e.decomposition == Decomposition::NONE     ? "none"
                          : e.decomposition == Decomposition::PRISMS ? "prisms"
                                                                     : "parts";
  if (e.decomposition == Decomposition::PARTS) {
    json["parts"] = e.object_fit.parts;
    json["max_parts"] = e.object_fit.max_parts;
    json["taper"] = options.taper.value_or(true);
    if (!options.mask.empty())
      json["mask"] = options.mask;
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
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
  if (options.taper.value_or(false))
    json["taper"] = true;
  if (!options.roi.empty())
    json["roi"] = options.roi;
  if (!options.box.empty())
    json["box"] = options.box;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string reportToJson(const ModelResult& result) {
  const EstimationReport& report = result.report;
  nlohmann::ordered_json json;
  const auto numbers = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json{v.x(), v.y(), v.z()};
  };
  if (result.up)
    json["up"] = numbers(*result.up);
  if (result.sensor) {
    json["sensor"] = numbers(*result.sensor);
    json["sensor_known"] = result.sensor_known;
  }
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
  }
  json["notes"] = report.notes;
  if (result.taper)
    json["taper"] = {
        {"margin", result.taper->margin},
        {"deviations", {result.taper->kx_deviation, result.taper->ky_deviation}}};
  json["grasp_points"] = report.grasp_indices.size();
  const Eigen::Vector3d size = sizeOf(result).sides;
  nlohmann::ordered_json all = {{"size", numbers(size)}};
  if (report.view.points.cols() > 0)
    all["confidence"] = report.confidence;
  all["report"] = json;
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace pcl_sq::app
