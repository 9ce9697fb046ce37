// SPDX-License-Identifier: BSD-3-Clause
// Model and cloud in, picture out.
#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "model/cloud_picture.h"
#include "model/export_output.h"
#include "model/model_input.h"
#include "options/frame_options.h"
#include "options/offset.h"

#include "pcl_sq/visualization/snapshot_renderer.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <optional>

using namespace pcl_sq;

namespace {

const char* const DESCRIPTION =
    "Takes a picture of a model or scene (JSON), with or without its point cloud. "
    "Works on machines without a display.";
const char* const EXAMPLES =
    "  pcl_sq_snapshot cup.json --cloud cup.pcd -o cup.png\n"
    "  pcl_sq_snapshot cup.json --view camera --size 640x480 -o cup.png\n"
    "  pcl_sq_snapshot cup.json --cloud cup.pcd --turntable 36 -o turn.png\n"
    "  pcl_sq_snapshot cup.json --cloud cup.pcd --html cup.html --export cup.sdf\n"
    "  pcl_sq_snapshot scene.json --cloud scene.pcd -o scene.png\n"
    "  pcl_sq_snapshot --cloud robot.pcd --up z --view top -o robot.png\n";

struct Arguments {
  std::string model, cloud, output, size = "1280x960", view = "iso";
  std::size_t object = 0; ///< of a scene, from 1 on; 0: all
  int turntable = 0;
  app::CloudOptions cloud_options;
  app::FrameOptions frame;
  SnapshotOptions options;
  app::ExportOptions exported;
};

void parseSize(const std::string& text, SnapshotOptions& options) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%4dx%4d%c", &options.width, &options.height, &rest) !=
      2)
    throw app::UsageError("--size " + text + " is not of the form 1280x960.");
}

void configure(CLI::App& cli, Arguments& a) {
  cli.add_option(
         "model", a.model, "Model or scene file; may be left out if there is a cloud")
      ->type_name("MODEL.json");
  cli.add_option("--object",
                 a.object,
                 "Number of the thing of a scene, from 1 on; 0: all of them")
      ->check(app::wholeNumber(0, 65535))
      ->capture_default_str();
  cli.add_option("--cloud", a.cloud, "Point cloud (PCD, PLY, OBJ, STL or text)")
      ->type_name("FILE");
  app::addCloudOptions(cli, a.cloud_options);
  cli.add_option("-o,--output", a.output, "Picture, ends in .png; -: standard output")
      ->type_name("FILE");
  app::addExportOptions(cli, a.exported);
  cli.add_option("--size", a.size, "Width x height [px], 16 to 4096 each")
      ->type_name("WxH")
      ->capture_default_str();
  cli.add_option("--view", a.view, "Where from; camera: the sensor's own image")
      ->check(app::oneOf({"front", "side", "top", "iso", "camera"}))
      ->capture_default_str();
  app::addFrameOptions(cli, a.frame);
  cli.add_option("--turntable", a.turntable, "N pictures all round: out_000.png ...")
      ->check(app::wholeNumber(1, 1000))
      ->type_name("N");
  cli.add_option("--opacity", a.options.opacity, "Of the superquadrics")
      ->check(app::number(0.0, 1.0))
      ->type_name("N")
      ->capture_default_str();
  cli.add_option("--context",
                 a.options.context,
                 "How far around the object the cloud is shown, in object sizes")
      ->check(app::number(0.0, 1e6))
      ->type_name("SIZES")
      ->capture_default_str();
  cli.add_option("--point-size", a.options.point_size, "[px]; 0: from the density")
      ->check(app::number(0.0, 100.0))
      ->type_name("PX")
      ->capture_default_str();
  cli.add_option("--title", a.options.title, "Large text at the top")
      ->type_name("TEXT");
  cli.add_option("--caption", a.options.caption, "Small text under the title");
}

/** \brief What can be wrong with the command line as a whole. */
void check(Arguments& a) {
  if (a.model.empty() && a.cloud.empty())
    throw app::UsageError("there is nothing to show; give a model, --cloud or both.");
  parseSize(a.size, a.options);
  if (const auto table = a.frame.tableOf())
    a.options.up = table->normal;
  if (const auto up = a.frame.upOf())
    a.options.up = *up;
  a.options.sensor = a.frame.viewpointOf();
  std::string why;
  if (!viewFromString(a.view, &a.options.view) || !a.options.isValid(&why))
    throw app::UsageError(why + ".");
  app::claimInput(a.model);
  app::claimInput(a.cloud);
  if (a.output.empty() && !a.exported.any())
    throw app::UsageError("there is nothing to write; give --output, --html or "
                          "--export.");
  if (!a.exported.exports.empty() && a.model.empty())
    throw app::UsageError("--export needs a model.");
  if (a.turntable > 0 && app::extensionOf(a.output) != ".png")
    throw app::UsageError("--turntable writes several files; give --output a name that "
                          "ends in .png.");
  app::claimOutput("--output", a.output, {".png"});
  app::checkExportOptions(a.exported);
}

/** \brief Three numbers that pcl_sq_fit reports: "up", "sensor"; if it does. */
std::optional<Eigen::Vector3d> reported(const ModelFile& file,
                                        const std::string& name) {
  const auto extra = nlohmann::json::parse(file.extra_json);
  const auto v = extra.value(nlohmann::json::json_pointer("/report/" + name),
                             nlohmann::json::array());
  if (!v.is_array() || v.size() != 3 || !v[0].is_number() || !v[1].is_number() ||
      !v[2].is_number())
    return std::nullopt;
  return Eigen::Vector3d(v[0], v[1], v[2]);
}

app::LoadedCloud readCloud(const Arguments& a) {
  app::StageLine line;
  line.show("reading");
  return app::loadCloud(a.cloud, a.cloud_options);
}

int takePictures(const Arguments& a) {
  SnapshotRenderer renderer(a.options);
  std::optional<app::LoadedCloud> cloud;
  if (!a.cloud.empty())
    cloud = readCloud(a);
  app::ModelInput input;
  if (!a.model.empty())
    input = app::readModelInput(a.model, a.object);
  ModelFile& file = input.file;
  if (a.object == 0 && !input.scene.objects.empty()) {
    for (const std::string& path : a.exported.exports)
      if (const std::string format = app::extensionOf(path);
          format == ".urdf" || format == ".sdf")
        throw app::UsageError("--export " + path +
                              " is of one thing; give --object, or write a .scene or "
                              ".glb.");
    app::writeExports(a.exported, input.scene, cloud ? &*cloud : nullptr);
  } else
    app::writeExports(a.exported, file, cloud ? &*cloud : nullptr);
  if (a.output.empty())
    return app::DONE;
  if (!a.model.empty()) {
    // pictures are made of floats
    const Eigen::Vector3d offset = cloud ? cloud->offset : app::offsetOf(file.model);
    file.model = app::moved(std::move(file.model), -offset);
    renderer.addModel(file.model);
    SnapshotOptions options = a.options;
    if (!options.sensor)
      options.sensor = reported(file, "sensor");
    if (options.sensor)
      *options.sensor -= offset;
    if (a.frame.up.empty() && a.frame.table.empty()) {
      if (const auto up = reported(file, "up"); up && up->norm() > 1e-6)
        options.up = *up;
      else if (file.table)
        options.up =
            Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(file.table->data()));
    }
    renderer.setOptions(options);
  }
  if (cloud)
    app::addCloud(renderer, *cloud);
  if (a.turntable == 0) {
    renderer.save(a.output);
    app::noteWritten(a.output);
    return app::DONE;
  }
  app::Progress progress("turntable", static_cast<std::size_t>(a.turntable));
  const std::vector<std::string> names = renderer.saveTurntable(
      a.output, a.turntable, [&](std::size_t done) { progress.update(done); });
  app::noteWritten(names.front());
  if (names.size() > 1)
    app::noteWritten(names.size() > 2 ? "... " + names.back() : names.back());
  return app::DONE;
}

} // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  return app::run(
      argc,
      argv,
      "pcl_sq_snapshot",
      DESCRIPTION,
      EXAMPLES,
      [&](CLI::App& cli) { configure(cli, arguments); },
      [&] {
        check(arguments);
        return takePictures(arguments);
      });
}
