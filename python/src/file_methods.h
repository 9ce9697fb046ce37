// SPDX-License-Identifier: BSD-3-Clause
// What model files and scene files have in common for Python.
#pragma once

#include "arrays.h"
#include "errors.h"
#include "point_clouds.h"

#include "pcl_sq/html_view.h"
#include "pcl_sq/robot_export.h"

#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::python {

/** \brief A library's function that takes the reason of its failure.
 * \throw app::Failure with the reason */
template <typename Function>
void succeed(const Function& function) {
  guarded([&] {
    std::string why;
    if (!function(&why))
      throw app::Failure(why + ".");
    return true;
  });
}

/** \brief to_json(), from_json(), save(), load(), and that copies are equal. \param[in]
 * kind of file, a noun */
template <typename File>
void addFileMethods(py::class_<File>& type,
                    const std::string& kind,
                    bool (*save)(const std::string&, const File&, std::string*),
                    bool (*load)(const std::string&, File&, std::string*)) {
  const auto read = [kind](const std::string& text) {
    File file;
    succeed([&](std::string* why) {
      const bool found = fromJson(text, file, why);
      *why = "this text is no " + kind + ": " + *why;
      return found;
    });
    return file;
  };
  type.def_readonly("frame", &File::frame)
      .def_readonly("table", &File::table)
      .def_readwrite("extra_json", &File::extra_json)
      .def("to_json",
           py::overload_cast<const File&, int>(&toJson),
           py::arg("indent") = 2)
      .def_static("from_json", read)
      .def(py::pickle([](const File& file) { return py::str(toJson(file, -1)); },
                      [read](const py::str& text) { return read(text); }))
      .def("save",
           [save](const File& file, const std::string& path) {
             succeed([&](std::string* why) { return save(path, file, why); });
           })
      .def_static("load", [load](const std::string& path) {
        File file;
        succeed([&](std::string* why) { return load(path, file, why); });
        return file;
      });
}

/** \brief The page of a model or a scene and its cloud. */
template <typename File>
std::string pageOf(const File& file, const PageCloud& seen, const std::string& title) {
  HtmlViewOptions options;
  options.title = title;
  const py::gil_scoped_release unlocked;
  return htmlView(file, seen.points, seen.offset, seen.colors, options);
}

/** \brief (name, bytes) of each file of a format. \throw std::invalid_argument */
template <typename File>
std::vector<std::pair<std::string, py::bytes>> exportOf(
    const File& file, const std::string& ending, const RobotExportOptions& options) {
  std::string why;
  if (!options.isValid(&why))
    throw std::invalid_argument(why);
  std::vector<std::pair<std::string, py::bytes>> files;
  for (const TextFile& text : robotFiles(ending, file, options))
    files.emplace_back(text.path, py::bytes(text.contents));
  return files;
}

} // namespace pcl_sq::python
