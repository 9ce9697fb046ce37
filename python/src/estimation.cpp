// SPDX-License-Identifier: BSD-3-Clause
// Models as the programs make them: their options, their sentences, their files.
#include "arrays.h"
#include "bodies.h"
#include "errors.h"
#include "file_methods.h"
#include "model/grasp_output.h"
#include "options/model_options.h"
#include "point_clouds.h"
#include "words.h"

#include "command_line/value_checks.h"
#include "pcl_sq/file_io.h"

namespace pcl_sq::python {

namespace {

using Words = std::vector<std::string>;

CellMask cellsOf(const py::array& mask) {
  if (mask.ndim() != 2)
    throw std::invalid_argument("mask wants an array of height x width");
  const auto set = py::array_t<bool, py::array::c_style | py::array::forcecast>(mask);
  const auto width = int(mask.shape(1)), height = int(mask.shape(0));
  CellMask cells(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      cells.set(x, y, set.at(y, x));
  return cells;
}

py::tuple estimate(const py::array& array,
                   const std::optional<py::array>& colors,
                   const std::optional<py::array>& mask,
                   const std::string& frame,
                   const Words& words) {
  app::Shape shape = shapeOf(PointArray(array), colors);
  CellMask cells;
  if (mask)
    cells = cellsOf(*mask);
  const app::ModelResult result = guarded([&] {
    auto options = readWords<app::ModelOptions>(
        "pcl_sq_fit", words, [](CLI::App& cli, app::ModelOptions& read) {
          app::addCloudOptions(cli, read.cloud);
          app::addModelOptions(cli, read);
          app::addCoverageOptions(cli, read);
        });
    options.estimation.view.mask = std::move(cells);
    if (mask && (options.remove_plane || !options.roi.empty() || !options.box.empty()))
      throw app::UsageError("mask says already which pixels are the object: leave out "
                            "roi, box and remove_plane.");
    if (mask && options.estimation.decomposition != Decomposition::PARTS)
      throw app::UsageError(
          "mask goes with preset best; the paper's chain takes roi or box.");
    app::checkModelOptions(options);
    app::LoadedCloud input = cloudOf(std::move(shape), options.cloud);
    input.cloud->header.frame_id = frame;
    return app::makeModel(input, "", options, 0.0);
  });
  std::vector<std::int64_t> indices(result.report.object_indices.begin(),
                                    result.report.object_indices.end());
  const auto count = static_cast<py::ssize_t>(indices.size());
  return py::make_tuple(result.file, ownedArray(std::move(indices), {count}));
}

/** \brief Grasps as the JSON that pcl_sq_grasp writes. \param[in] obstacles what else
 * stands there */
std::string planGrasps(const ModelFile& file,
                       const std::optional<py::array>& cloud,
                       const MultiSuperquadric& obstacles,
                       const Words& words) {
  std::optional<app::Shape> shape;
  if (cloud)
    shape = shapeOf(PointArray(*cloud), std::nullopt);
  return guarded([&] {
    app::GraspOptions options; // a gripper's file may change from call to call
    app::parseWords(
        "pcl_sq_grasp",
        [&](CLI::App& cli) {
          app::addGripperOptions(cli, options);
          app::addFrameOptions(cli, options.frame);
          cli.add_option("--count", options.planner.count)
              ->check(app::wholeNumber(1, 10000));
        },
        words);
    app::checkGraspOptions(options);
    std::optional<app::LoadedCloud> input;
    if (shape)
      input = cloudOf(std::move(*shape), {});
    GraspScene scene = app::makeScene(options, file, input ? &*input : nullptr);
    if (input)
      scene.cloud = app::columnsOf(*input);
    scene.obstacles = obstacles;
    double milliseconds = 0.0;
    const GraspPlan plan = app::planGrasps(file.model, scene, options, milliseconds);
    if (!plan.ok())
      throw app::Failure(plan.failure);
    return app::graspsToJson(plan, scene, options, file.frame, "", milliseconds);
  });
}

std::string html(const ModelFile& file,
                 const std::optional<py::array>& cloud,
                 const std::optional<py::array>& colors,
                 const std::string& title) {
  return pageOf(file, PageCloud(cloud, colors, file.model), title);
}

std::vector<std::pair<std::string, py::bytes>> robotExport(const ModelFile& file,
                                                           const std::string& ending,
                                                           const std::string& name,
                                                           double density,
                                                           const std::string& prefix) {
  RobotExportOptions options;
  options.name = name;
  options.density = density;
  options.mesh_prefix = prefix;
  return exportOf(file, ending, options);
}

} // namespace

void addEstimation(py::module_& module) {
  py::class_<ModelFile> type(module, "ModelFile", "The contents of a model file.");
  type.def_readwrite("model", &ModelFile::model)
      .def_readonly("rms_distance", &ModelFile::rms_distance)
      .def_readonly("distortion", &ModelFile::distortion)
      .def_static("of_union", [](const MultiSuperquadric& model) {
        ModelFile file;
        file.model = model;
        return file;
      });
  addFileMethods(type, "model", &saveModel, &loadModel);
  module.def("estimate", &estimate);
  module.def("plan_grasps", &planGrasps);
  module.def("html", &html);
  module.def("robot_export", &robotExport);
  module.def("write_file", [](const std::string& path, const std::string& bytes) {
    succeed([&](std::string* why) { return writeFile(path, bytes, why); });
  });
}

} // namespace pcl_sq::python
