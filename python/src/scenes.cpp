// SPDX-License-Identifier: BSD-3-Clause
// All things on a table, as pcl_sq_scene makes them.
#include "arrays.h"
#include "bodies.h"
#include "errors.h"
#include "file_methods.h"
#include "model/scene_model.h"
#include "point_clouds.h"

namespace pcl_sq::python {

namespace {

py::tuple estimateScene(const py::array& array,
                        const std::optional<py::array>& colors,
                        const std::optional<py::array>& labels,
                        const std::string& frame,
                        const std::vector<std::string>& words) {
  app::Shape shape = shapeOf(PointArray(array), colors);
  app::SceneChoices choices;
  if (labels)
    choices.labels = labelsOf(*labels);
  app::SceneResult result = guarded([&] {
    app::ModelOptions options;
    app::parseWords(
        "pcl_sq_scene",
        [&](CLI::App& cli) { app::addSceneOptions(cli, options, choices); },
        words);
    app::checkModelOptions(options);
    app::LoadedCloud input = cloudOf(std::move(shape), options.cloud);
    input.cloud->header.frame_id = frame;
    return app::makeSceneFile(input, "", options, choices, 0.0);
  });
  LabelImage numbers = app::numberedPixels(result);
  return py::make_tuple(
      std::move(result.file),
      ownedArray(std::move(numbers.values), {numbers.height, numbers.width}));
}

/** \brief A thing as a model file on the scene's table. */
ModelFile thingOf(const SceneFile& scene, std::size_t k) {
  ModelFile file = scene.objects.at(k).file;
  if (!file.table)
    file.table = scene.table;
  return file;
}

py::tuple seenOf(const SceneFile& scene, std::size_t k) {
  const SceneFileObject& object = scene.objects.at(k);
  const CellRect& r = object.roi;
  return py::make_tuple(py::make_tuple(r.x, r.y, r.width, r.height),
                        object.pixels,
                        object.visible,
                        object.confidence,
                        object.notes);
}

std::string sceneHtml(const SceneFile& file,
                      const std::optional<py::array>& cloud,
                      const std::optional<py::array>& colors,
                      const std::string& title) {
  return pageOf(file, PageCloud(cloud, colors, file.all()), title);
}

std::vector<std::pair<std::string, py::bytes>>
sceneExport(const SceneFile& file, const std::string& ending, const std::string& name) {
  RobotExportOptions options;
  options.name = name;
  return exportOf(file, ending, options);
}

} // namespace

void addScenes(py::module_& module) {
  py::class_<SceneFile> type(module, "SceneFile", "The contents of a scene file.");
  type.def("__len__", [](const SceneFile& file) { return file.objects.size(); })
      .def("thing", &thingOf)
      .def("seen", &seenOf)
      .def_readonly("notes", &SceneFile::notes)
      .def("all", &SceneFile::all, py::arg("without") = std::size_t(-1));
  addFileMethods(type, "scene", &saveScene, &loadScene);
  module.def("estimate_scene", &estimateScene);
  module.def("scene_html", &sceneHtml);
  module.def("scene_export", &sceneExport);
}

} // namespace pcl_sq::python
