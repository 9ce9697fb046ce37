// SPDX-License-Identifier: BSD-3-Clause
#include "model/export_output.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/graspit_folder.h"

#include "pcl_sq/html_view.h"
#include "pcl_sq/robot_export.h"

#include <filesystem>

namespace pcl_sq::app {

namespace {

const std::vector<std::string> ENDINGS = {".glb", ".urdf", ".sdf", ".scene"};

void writeExport(const std::string& path, const ModelFile& file) {
  RobotExportOptions options;
  options.name = graspitName(path);
  const std::vector<TextFile> files =
      robotFiles(formatOf(path, ENDINGS.front()), file, options);
  if (files.empty())
    throw Failure("the model has no parts, so '" + path + "' is not written.");
  writeOutput(path, files.front().contents);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (std::size_t i = 1; i < files.size(); ++i) // meshes that it names
    writeOutput((folder / files[i].path).string(), files[i].contents);
}

} // namespace

void addHtmlOption(CLI::App& cli, ExportOptions& options) {
  cli.add_option(
         "--html",
         options.html,
         "Page to turn in a browser, one file that works offline: cloud, parts, "
         "grasps, table, camera")
      ->type_name("FILE");
}

void addExportOptions(CLI::App& cli, ExportOptions& options) {
  cli.add_option("--export",
                 options.exports,
                 "Model as .urdf, .sdf (meshes they name are written beside them), "
                 "MoveIt's .scene or .glb; several times for several")
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
  addHtmlOption(cli, options);
}

void checkExportOptions(const ExportOptions& options) {
  for (const std::string& path : options.exports) {
    claimOutput("--export", path, ENDINGS);
    if ((extensionOf(path) == ".urdf" || extensionOf(path) == ".sdf") &&
        std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
      throw UsageError("--export " + path +
                       " writes meshes beside it; name a file in a folder.");
  }
  claimOutput("--html", options.html, {".html", ".htm"});
}

void writeExports(const ExportOptions& options,
                  const ModelFile& file,
                  const LoadedCloud* cloud) {
  for (const std::string& path : options.exports)
    writeExport(path, file);
  if (options.html.empty())
    return;
  HtmlViewOptions settings;
  settings.title = std::filesystem::path(file.input_path).filename().string();
  if (settings.title.empty())
    settings.title = std::filesystem::path(options.html).stem().string();
  const Eigen::Matrix3Xf none(3, 0);
  std::vector<std::uint32_t> colors;
  if (cloud && cloud->has_color)
    for (const auto& p : *cloud->cloud)
      colors.push_back(p.rgba & 0xffffffU);
  writeOutput(options.html,
              htmlView(file,
                       cloud ? coordinatesOf(*cloud) : CloudPoints(none),
                       cloud ? cloud->offset : Eigen::Vector3d(0.0, 0.0, 0.0),
                       colors,
                       settings));
}

} // namespace pcl_sq::app
