// SPDX-License-Identifier: BSD-3-Clause
#include "point_clouds.h"

#include "command_line/app.h"

namespace pcl_sq::python {

app::Shape shapeOf(const PointArray& points, const std::optional<py::array>& colors) {
  app::Shape shape;
  const auto count = static_cast<std::size_t>(points.size());
  shape.points.resize(count);
  points.visit([&](const auto& columns) {
    for (std::size_t i = 0; i < count; ++i)
      shape.points[i] = columns.col(Eigen::Index(i)).template cast<double>();
  });
  if (points.shape().size() == 2) {
    shape.height = static_cast<std::uint32_t>(points.shape()[0]);
    shape.width = static_cast<std::uint32_t>(points.shape()[1]);
  }
  if (colors)
    shape.colors = colorsOf(*colors, points.size());
  return shape;
}

app::LoadedCloud cloudOf(app::Shape shape, const app::CloudOptions& options) {
  try {
    return app::makeCloud(std::move(shape), options);
  } catch (const app::Failure& failure) {
    throw app::Failure("the points make no cloud: " + std::string(failure.what()) +
                       ".");
  }
}

LabelImage labelsOf(const py::array& labels) {
  const char kind = labels.dtype().kind();
  if (labels.ndim() != 2 || (kind != 'i' && kind != 'u'))
    throw std::invalid_argument(
        "labels want an array of whole numbers, height x width: 0 for no thing");
  const auto numbers =
      py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>(labels);
  LabelImage image(int(labels.shape(1)), int(labels.shape(0)));
  const std::int64_t* number = numbers.data();
  for (std::uint16_t& value : image.values) {
    if (*number < 0 || *number > 65535)
      throw std::invalid_argument("labels want numbers from 0 to 65535");
    value = static_cast<std::uint16_t>(*number++);
  }
  return image;
}

PageCloud::PageCloud(const std::optional<py::array>& cloud,
                     const std::optional<py::array>& cloud_colors,
                     const MultiSuperquadric& model)
    : points(3, 0) {
  if (!cloud)
    return;
  const PointArray array(*cloud);
  if (!model.empty())
    offset = model.parts.front().center.array().round().matrix();
  points = (array.columns().colwise() - offset).cast<float>();
  if (cloud_colors)
    colors = colorsOf(*cloud_colors, array.size());
}

} // namespace pcl_sq::python
