// SPDX-License-Identifier: BSD-3-Clause
// Pictures; loads VTK.
#include "arrays.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/model_io.h"
#include "pcl_sq/visualization/snapshot_renderer.h"

namespace pcl_sq::python {

namespace {

/** \brief A picture as height x width x 3 bytes. \throw std::runtime_error with the
 * library's sentence */
py::array_t<std::uint8_t> render(const std::string& model,
                                 const std::optional<py::array>& cloud,
                                 const std::optional<py::array>& colors,
                                 const std::string& view,
                                 const std::optional<Eigen::Vector3d>& up,
                                 const std::optional<Eigen::Vector3d>& sensor,
                                 int width,
                                 int height,
                                 double opacity,
                                 const std::string& title) {
  SnapshotOptions options;
  options.width = width;
  options.height = height;
  options.opacity = opacity;
  options.title = title;
  options.sensor = sensor;
  if (up)
    options.up = *up;
  if (!viewFromString(view, &options.view))
    throw std::invalid_argument("view wants front, side, top, iso or camera, not '" +
                                view + "'");
  ModelFile file;
  std::string why;
  if (!fromJson(model, file, &why))
    throw std::invalid_argument(why);
  SnapshotImage image;
  Eigen::Matrix3Xd points(3, 0);
  SnapshotRenderer::Colors bytes;
  if (cloud) {
    const PointArray array(*cloud);
    points = array.columns();
    if (colors) {
      const std::vector<std::uint32_t> packed = colorsOf(*colors, array.size());
      bytes.resize(3, array.size());
      for (Eigen::Index i = 0; i < array.size(); ++i) {
        const std::uint32_t c = packed[static_cast<std::size_t>(i)];
        bytes.col(i) << std::uint8_t(c >> 16U), std::uint8_t(c >> 8U), std::uint8_t(c);
      }
    }
  }
  try {
    const py::gil_scoped_release unlocked;
    SnapshotRenderer renderer(options);
    if (points.cols() > 0)
      renderer.addCloud(points, bytes);
    renderer.addModel(file.model);
    image = renderer.render();
  } catch (const Exception& error) {
    const std::string text = error.what();
    const std::size_t place = text.find("] ");
    throw std::runtime_error(place == std::string::npos ? text
                                                        : text.substr(place + 2));
  }
  const py::ssize_t rows = image.height, columns = image.width;
  return ownedArray(std::move(image.rgb), {rows, columns, 3});
}

} // namespace

} // namespace pcl_sq::python

PYBIND11_MODULE(_render, module) {
  module.def("render", &pcl_sq::python::render);
}
