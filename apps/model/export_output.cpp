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

/** \brief \tparam Contents ModelFile or SceneFile */
template <typename Contents>
void writeExport(const std::string& path, const Contents& contents) {
  RobotExportOptions options;
  options.name = graspitName(path);
  const std::vector<TextFile> files =
      robotFiles(formatOf(path, ENDINGS.front()), contents, options);
  if (files.empty())
    throw Failure("the model has no parts, so '" + path + "' is not written.");
  writeOutput(path, files.front().contents);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (std::size_t i = 1; i < files.size(); ++i) // meshes that it names
    writeOutput((folder / files[i].path).string(), files[i].contents);
}

template <typename Contents>
void writePage(const std::string& path,
               const Contents& contents,
               const LoadedCloud* cloud) {
  HtmlViewOptions settings;
  settings.title = std::filesystem::path(contents.input_path).filename().string();
  if (settings.title.empty())
    settings.title = std::filesystem::path(path).stem().string();
  const Eigen::Matrix3Xf none(3, 0);
  std::vector<std::uint32_t> colors;
  if (cloud && cloud->has_color)
    for (const auto& p : *cloud->cloud)
      colors.push_back(p.rgba & 0xffffffU);
  writeOutput(path,
              htmlView(contents,
                       cloud ? coordinatesOf(*cloud) : CloudPoints(none),
                       cloud ? cloud->offset : Eigen::Vector3d(0.0, 0.0, 0.0),
                       colors,
                       settings));
}

template <typename Contents>
void writeAll(const ExportOptions& options,
              const Contents& contents,
              const LoadedCloud* cloud) {
  for (const std::string& path : options.exports)
    writeExport(path, contents);
  if (!options.html.empty())
    writePage(options.html, contents, cloud);
}

void addExport(CLI::App& cli, ExportOptions& options, const std::string& text) {
  cli.add_option("--export", options.exports, text)
      ->expected(1)
      ->take_all()
      ->type_name("FILE");
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
  addExport(cli,
            options,
            "Model as .urdf, .sdf (meshes they name are written beside them), "
            "MoveIt's .scene or .glb; several times for several");
  addHtmlOption(cli, options);
}

void addSceneExportOptions(CLI::App& cli, ExportOptions& options) {
  addExport(cli,
            options,
            "All things and the table as MoveIt's .scene or as .glb; several times for "
            "several");
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

void checkSceneExportOptions(const ExportOptions& options) {
  for (const std::string& path : options.exports)
    claimOutput("--export", path, {".glb", ".scene"});
  claimOutput("--html", options.html, {".html", ".htm"});
}

void writeExports(const ExportOptions& options,
                  const ModelFile& file,
                  const LoadedCloud* cloud) {
  writeAll(options, file, cloud);
}

void writeExports(const ExportOptions& options,
                  const SceneFile& scene,
                  const LoadedCloud* cloud) {
  writeAll(options, scene, cloud);
}

} // namespace pcl_sq::app
