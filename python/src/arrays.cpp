// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.h"

#include <stdexcept>

namespace pcl_sq::python {

namespace {

/** \brief Distance of the rows in numbers of type T; 0 where they cannot be used where
 * they are. */
template <typename T>
py::ssize_t evenStride(const py::array& array) {
  constexpr py::ssize_t SIZE = sizeof(T);
  if (!py::isinstance<py::array_t<T>>(array) || // of this type and byte order
      reinterpret_cast<std::uintptr_t>(array.data()) % SIZE != 0)
    return 0;
  const py::ssize_t last = array.ndim() - 1;
  if (array.strides(last) != SIZE)
    return 0;
  if (last == 0)
    return 3;
  const py::ssize_t stride = array.strides(last - 1);
  if (stride % SIZE != 0 || stride < SIZE)
    return 0;
  for (py::ssize_t i = last - 1; i > 0; --i)
    if (array.strides(i - 1) != array.strides(i) * array.shape(i))
      return 0;
  return stride / SIZE;
}

} // namespace

std::string shapeText(const py::array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    text += (i > 0 ? " x " : "") + std::to_string(array.shape(i));
  return text.empty() ? "a single number" : text;
}

PointArray::PointArray(const py::object& points) {
  // masked arrays and fields x, y, z are numpy's to tell apart
  const bool simple =
      py::type::of(points).is(py::module_::import("numpy").attr("ndarray")) &&
      py::array(points).dtype().attr("names").is_none();
  const py::array array = py::array::ensure(
      simple ? points
             : py::module_::import("pcl_sq._arrays").attr("points_of")(points));
  if (!array) {
    PyErr_Clear();
    throw py::type_error("points want an array of numbers, float32 or float64");
  }
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw py::type_error("points want an array of numbers, float32 or float64");
  if (array.ndim() < 1 || array.ndim() > 3 || array.shape(array.ndim() - 1) != 3)
    throw std::invalid_argument(
        "points want an array of N x 3, or of H x W x 3 for an image of points, not " +
        shapeText(array));
  shape_.assign(array.shape(), array.shape() + array.ndim() - 1);
  count_ = array.size() / 3;
  owner_ = array;
  stride_ = evenStride<float>(array);
  single_ = stride_ > 0;
  if (!single_)
    stride_ = evenStride<double>(array);
  if (stride_ == 0) {
    stride_ = 3;
    single_ = kind == 'f' && array.itemsize() <= 4;
    if (single_)
      owner_ = py::array_t<float, py::array::c_style | py::array::forcecast>(array);
    else
      owner_ = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  }
  data_ = owner_.data();
}

py::object meshToPython(const TriangleMesh& mesh) {
  std::vector<double> vertices;
  vertices.reserve(3 * mesh.vertices.size());
  for (const Eigen::Vector3d& v : mesh.vertices)
    vertices.insert(vertices.end(), v.data(), v.data() + 3);
  std::vector<std::uint32_t> triangles;
  triangles.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    triangles.insert(triangles.end(), t.begin(), t.end());
  const auto rows = [](std::size_t n) { return static_cast<py::ssize_t>(n); };
  return py::module_::import("pcl_sq._types")
      .attr("Mesh")(ownedArray(std::move(vertices), {rows(mesh.vertices.size()), 3}),
                    ownedArray(std::move(triangles), {rows(mesh.triangles.size()), 3}));
}

std::vector<std::uint32_t> colorsOf(const py::array& colors, Eigen::Index points) {
  if (!py::isinstance<py::array_t<std::uint8_t>>(colors))
    throw py::type_error("colours want an array of uint8: red, green, blue");
  if (colors.ndim() < 1 || colors.shape(colors.ndim() - 1) != 3 ||
      colors.size() != 3 * points)
    throw std::invalid_argument("colours want three bytes for each point, not " +
                                shapeText(colors));
  const auto bytes = py::array_t<std::uint8_t, py::array::c_style>::ensure(colors);
  std::vector<std::uint32_t> packed(static_cast<std::size_t>(points));
  const std::uint8_t* c = bytes.data();
  for (std::uint32_t& color : packed) {
    color = std::uint32_t(c[0]) << 16U | std::uint32_t(c[1]) << 8U | c[2];
    c += 3;
  }
  return packed;
}

} // namespace pcl_sq::python
