// SPDX-License-Identifier: BSD-3-Clause
// A model against what is known of the object.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/cloud_io.h"
#include "files/files.h"
#include "model/model_input.h"
#include "options/offset.h"
#include "scene/evaluation.h"
#include "scene/mesh_reader.h"
#include "scene/pose_file.h"
#include "scene/truth.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>

using namespace pcl_sq;
using namespace pcl_sq::app;

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string model, truth, mesh, pose, cloud, output;
  std::string symmetry = "none", format = "json";
  std::size_t samples = 60000;
  std::size_t object = 0; ///< of a scene, from 1 on; 0: all
  unsigned int threads = 0;
  CloudOptions cloud_options;
};

void addOptions(CLI::App& cli, Options& o) {
  cli.add_option("model", o.model, "Model or scene to judge (JSON); -: standard input")
      ->required()
      ->type_name("FILE");
  cli.add_option("--object",
                 o.object,
                 "Number of the thing of a scene, from 1 on; 0: all of them as one")
      ->check(wholeNumber(0, 65535))
      ->capture_default_str();
  cli.add_option("--truth", o.truth, "truth.json of pcl_sq_render")->type_name("FILE");
  cli.add_option("--mesh", o.mesh, "Closed mesh of the object, OBJ/STL/PLY")
      ->type_name("FILE");
  cli.add_option("--pose",
                 o.pose,
                 "Mesh to model's frame: 16 numbers (rows, commas between), a file of "
                 "them, or FILE.yml:NAME of an OpenCV file")
      ->type_name("POSE");
  cli.add_option("--symmetry", o.symmetry, "Of the mesh; revolution is about its z")
      ->check(oneOf({"none", "box", "revolution", "sphere"}))
      ->capture_default_str();
  cli.add_option("--cloud", o.cloud, "Measured points of the object")
      ->type_name("FILE");
  addUnitOption(cli, o.cloud_options);
  cli.add_option("--samples", o.samples, "Points for each of volume and surfaces")
      ->check(wholeNumber(1000, 10000000))
      ->capture_default_str();
  cli.add_option("--format", o.format, "What is printed")
      ->check(oneOf({"json", "table"}))
      ->capture_default_str();
  cli.add_option("-o,--output", o.output, "Also write the JSON to a file")
      ->type_name("FILE");
  cli.add_option("--threads", o.threads, "0 = all cores")->check(wholeNumber(0, 1024));
}

ReferenceShape loadShape(const Options& o) {
  ReferenceShape shape;
  if (o.truth.empty()) {
    shape.mesh = readMesh(o.mesh, o.cloud_options);
    if (!o.pose.empty())
      readPose(o.pose, shape.rotation, shape.translation);
    if (!symmetryFromString(o.symmetry, &shape.symmetry))
      throw UsageError("unknown symmetry.");
    if (const std::size_t open = openEdges(shape.mesh); open > 0)
      note("the mesh is open: " + std::to_string(open) +
           " of its edges belong to one triangle, so that its volume and the overlap "
           "are no more than a guess; close its holes");
    return shape;
  }
  const SceneTruth truth = readTruth(o.truth);
  const auto folder = std::filesystem::path(o.truth).parent_path();
  shape.mesh = readMesh((folder / truth.mesh).string());
  shape.rotation = truth.rotation;
  shape.translation = truth.translation;
  shape.symmetry = truth.symmetry;
  return shape;
}

Json toJson(const DistanceFigures& d) {
  return {{"mean", d.mean}, {"rms", d.rms}, {"median", d.median}, {"max", d.max}};
}

Json toJson(const ShapeFigures& f) {
  const auto size = [](const Eigen::Vector3d& s) {
    return Json{{"width", s.x()}, {"height", s.z()}, {"thickness", s.y()}};
  };
  const Eigen::Vector3d& c = f.center_error;
  return {{"size", size(f.model_size)},
          {"true_size", size(f.true_size)},
          {"size_error", size(f.model_size - f.true_size)},
          {"center_error", Json::array({c.x(), c.y(), c.z()})},
          {"center_distance", c.norm()},
          {"axis_error_deg", f.axis_error_deg},
          {"iou", f.iou},
          {"iou_material", f.iou_material},
          {"volume", f.model_volume},
          {"true_volume", f.true_volume},
          {"chamfer", f.chamfer()},
          {"model_to_truth", toJson(f.model_to_truth)},
          {"truth_to_model", toJson(f.truth_to_model)}};
}

Eigen::Matrix3Xd finitePoints(const LoadedCloud& input) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(input.finite_points));
  Eigen::Index n = 0;
  for (const auto& p : *input.cloud)
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
      points.col(n++) = p.getVector3fMap().cast<double>();
  points.conservativeResize(Eigen::NoChange, n);
  return points;
}

void printTable(const Json& json) {
  const auto line = [](const char* name, double value, const char* unit) {
    std::printf("%-26s %12.4f %s\n", name, value, unit);
  };
  std::printf("%-26s %12d\n", "superquadrics", json["superquadrics"].get<int>());
  if (json.contains("shape")) {
    const Json& s = json["shape"];
    for (const char* side : {"width", "height", "thickness"})
      std::printf("%-26s %12.2f mm   true %8.2f   error %+7.2f\n",
                  side,
                  1e3 * s["size"][side].get<double>(),
                  1e3 * s["true_size"][side].get<double>(),
                  1e3 * s["size_error"][side].get<double>());
    for (int k = 0; k < 3; ++k)
      line(k == 0   ? "centre error x"
           : k == 1 ? "centre error y"
                    : "centre error z",
           1e3 * s["center_error"][static_cast<std::size_t>(k)].get<double>(),
           "mm");
    line("axis error", s["axis_error_deg"].get<double>(), "deg");
    line("IoU of the volumes", s["iou"].get<double>(), "");
    if (std::abs(s["iou_material"].get<double>() - s["iou"].get<double>()) > 1e-3)
      line("IoU of the walls alone", s["iou_material"].get<double>(), "");
    line("model to truth, mean", 1e3 * s["model_to_truth"]["mean"].get<double>(), "mm");
    line("truth to model, mean", 1e3 * s["truth_to_model"]["mean"].get<double>(), "mm");
    line("chamfer", 1e3 * s["chamfer"].get<double>(), "mm");
  }
  if (json.contains("cloud"))
    for (const char* figure : {"rms", "median"})
      line((std::string("cloud to model, ") + figure).c_str(),
           1e3 * json["cloud"]["distance"][figure].get<double>(),
           "mm");
  line("D (Eq. 7, mm)", json["distortion_mm"].get<double>(), "");
}

int work(const Options& o) {
  if (o.truth.empty() && o.mesh.empty() && o.cloud.empty())
    throw UsageError("give --truth, --mesh or --cloud to judge the model against.");
  for (const std::string& input : {o.model, o.truth, o.mesh, o.cloud})
    claimInput(input);
  claimOutput("--output", o.output);
  // the figures on standard output are for programs: nothing else may be there
  const bool print_json = o.format == "json" && !isStandardOutput(o.output);
  if (print_json)
    claimOutput("--format json", "-");
  const ModelInput input = readModelInput(o.model, o.object);
  const std::size_t things = o.object > 0 ? 1 : input.scene.objects.size();
  if (things > 1 && (!o.truth.empty() || !o.mesh.empty()))
    throw UsageError("the scene has " + std::to_string(things) +
                     " things, a mesh or truth is of one; give --object.");
  const ModelFile& file = input.file;
  const MultiSuperquadric& model = file.model;
  StageLine line;
  const auto show = [&line](const char* what, double share) {
    line.show("comparing " + std::string(what), share);
  };
  Json json = {{"schema", "pcl_sq/evaluation"},
               {"version", 1},
               {"unit", "m"},
               {"model", o.model},
               {"superquadrics", file.model.size()}};
  // without a cloud, D as the fit reported it: metres^1.5 to millimetres^1.5
  json["distortion_mm"] = file.distortion * std::pow(1e3, 1.5);
  if (!o.truth.empty() || !o.mesh.empty())
    json["shape"] =
        toJson(evaluateShape(model, loadShape(o), o.samples, o.threads, show));
  if (!o.cloud.empty()) {
    const LoadedCloud cloud = loadCloud(o.cloud, o.cloud_options);
    const Eigen::Matrix3Xd points = finitePoints(cloud);
    if (points.cols() == 0)
      throw Failure("'" + o.cloud + "' holds no finite point.");
    ModelFile near = file;
    near.model = moved(std::move(near.model), -cloud.offset);
    const CloudFigures c = evaluateCloud(near.model, points, o.threads, show);
    json["cloud"] = {{"points", c.points}, {"distance", toJson(c.distance)}};
    json["distortion_mm"] = c.distortion_mm;
  }
  line.clear();
  // names may hold bytes that are not UTF-8
  const std::string text =
      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (!o.output.empty())
    writeOutput(o.output, text);
  if (print_json)
    writeOutput("-", text);
  if (o.format == "table")
    printTable(json);
  return DONE;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  return run(
      argc,
      argv,
      "pcl_sq_evaluate",
      "Judges a model: sizes, place, overlap and distances against the truth.",
      "  pcl_sq_evaluate model.json --truth bottle/truth.json --format table\n"
      "  pcl_sq_evaluate model.json --mesh mug.stl --pose gt.yml:T_mesh_to_rectleft\n"
      "  pcl_sq_evaluate model.json --cloud object.pcd\n",
      [&](CLI::App& cli) { addOptions(cli, options); },
      [&] { return work(options); });
}
