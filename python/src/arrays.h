// SPDX-License-Identifier: BSD-3-Clause
// numpy's arrays as the library's points, and back.
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

namespace pcl_sq::python {

namespace py = pybind11;

/** \brief An array's shape for a message, "480 x 640". */
std::string shapeText(const py::array& array);

/** \brief Points of an array, or of what numpy makes one of, whose last side is three:
 * one point, N x 3, H x W x 3.
 *
 * Rows of floats or doubles at an even distance are used where they are; what is not
 * even, aligned, native or of these types is copied. */
class PointArray {
public:
  /** \throw std::invalid_argument for another shape \throw py::type_error if it holds
   * no real numbers */
  explicit PointArray(const py::object& points);

  Eigen::Index size() const { return count_; }
  /** \brief The array's shape without the coordinates. */
  const std::vector<py::ssize_t>& shape() const { return shape_; }

  /** \brief Calls f with the points as columns, floats or doubles. */
  template <typename Function>
  auto visit(const Function& f) const {
    if (single_)
      return f(CloudPoints(Eigen::Map<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>>(
          static_cast<const float*>(data_), 3, count_, Eigen::OuterStride<>(stride_))));
    return f(Eigen::Ref<const Eigen::Matrix3Xd>(
        Eigen::Map<const Eigen::Matrix3Xd, 0, Eigen::OuterStride<>>(
            static_cast<const double*>(data_),
            3,
            count_,
            Eigen::OuterStride<>(stride_))));
  }
  /** \brief A copy as doubles. */
  Eigen::Matrix3Xd columns() const {
    return visit([](const auto& points) -> Eigen::Matrix3Xd {
      return points.template cast<double>();
    });
  }

private:
  py::array owner_;
  const void* data_ = nullptr;
  bool single_ = false;
  Eigen::Index count_ = 0, stride_ = 3;
  std::vector<py::ssize_t> shape_;
};

/** \brief An array that owns the vector's memory. */
template <typename T>
py::array_t<T> ownedArray(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<decltype(kept)>(p); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}

/** \brief One value for each point, in the points' shape; a number for one point. */
template <typename T>
py::object valuesLike(const PointArray& points, std::vector<T>&& values) {
  if (points.shape().empty())
    return py::cast(T(values.at(0)));
  return ownedArray(std::move(values), points.shape());
}

/** \brief (vertices N x 3, triangles M x 3). */
py::object meshToPython(const TriangleMesh& mesh);

/** \brief Colours of points, uint8 with a last side of three: 0xRRGGBB each.
 * \throw std::invalid_argument if they are not as many as the points */
std::vector<std::uint32_t> colorsOf(const py::array& colors, Eigen::Index points);

} // namespace pcl_sq::python
