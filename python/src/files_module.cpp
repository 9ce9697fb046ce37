// SPDX-License-Identifier: BSD-3-Clause
// Clouds from files, by the programs' readers; PCL's reader of compressed PCD brings
// VTK.
#include "arrays.h"
#include "errors.h"
#include "files/cloud_io.h"
#include "model/model_line.h"
#include "words.h"

#include "command_line/value_checks.h"

#include <pcl/console/print.h>

namespace pcl_sq::python {

namespace {

using Words = std::vector<std::string>;

py::array_t<std::uint8_t> colorArray(const app::LoadedCloud& cloud,
                                     const std::vector<py::ssize_t>& shape) {
  py::array_t<std::uint8_t> colors(shape);
  std::uint8_t* out = colors.mutable_data();
  for (const auto& p : *cloud.cloud) {
    *out++ = p.r;
    *out++ = p.g;
    *out++ = p.b;
  }
  return colors;
}

/** \brief Coordinates in single precision, in double where that would lose digits. */
template <typename T>
py::array coordinates(const app::LoadedCloud& cloud,
                      const std::vector<py::ssize_t>& shape) {
  py::array_t<T> points(shape);
  T* out = points.mutable_data();
  for (const auto& p : *cloud.cloud)
    for (int k = 0; k < 3; ++k)
      *out++ = static_cast<T>(double(p.data[k]) + cloud.offset[k]);
  return points;
}

py::tuple readCloud(const std::string& path, const Words& words) {
  app::LoadedCloud cloud;
  std::optional<Eigen::Vector3d> viewpoint;
  guarded([&] {
    app::CloudOptions options;
    app::parseWords(
        "pcl_sq_fit",
        [&](CLI::App& cli) { app::addCloudOptions(cli, options); },
        words);
    cloud = app::readCloud(path, options);
    viewpoint = app::viewpointOf(cloud);
    return true;
  });
  const auto width = py::ssize_t(cloud.cloud->width),
             height = py::ssize_t(cloud.cloud->height);
  const std::vector<py::ssize_t> shape =
      height > 1 ? std::vector<py::ssize_t>{height, width, 3}
                 : std::vector<py::ssize_t>{py::ssize_t(cloud.cloud->size()), 3};
  if (viewpoint)
    *viewpoint += cloud.offset;
  return py::make_tuple(cloud.offset.isZero() ? coordinates<float>(cloud, shape)
                                              : coordinates<double>(cloud, shape),
                        cloud.has_color ? py::object(colorArray(cloud, shape))
                                        : py::object(py::none()),
                        viewpoint,
                        cloud.notes);
}

/** \brief The line of pcl_sq_fit --jsonl, and whether it holds a model. */
py::tuple fitLine(const std::string& path, const Words& words) {
  const app::ModelLine line = guarded([&] {
    const auto options = readWords<app::ModelOptions>(
        "pcl_sq_fit", words, [](CLI::App& cli, app::ModelOptions& read) {
          app::addCloudOptions(cli, read.cloud);
          app::addModelOptions(cli, read);
          app::addCoverageOptions(cli, read);
        });
    app::checkModelOptions(options);
    return app::makeModelLine(path, options);
  });
  return py::make_tuple(line.line, line.failure);
}

} // namespace

} // namespace pcl_sq::python

PYBIND11_MODULE(_files, module) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  module.def("read_cloud", &pcl_sq::python::readCloud);
  module.def("fit_line", &pcl_sq::python::fitLine);
}
