// SPDX-License-Identifier: BSD-3-Clause
// What bodies say of points, for arrays of them.
#pragma once

#include "arrays.h"
#include "errors.h"
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/fit_tapered.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/sides.h"

#include <pybind11/operators.h>

#include <limits>
#include <sstream>

namespace pcl_sq::python {

/** \brief f of each point; NaN where a coordinate is not finite. */
template <typename Function>
py::object eachPoint(const py::object& array, const Function& f) {
  const PointArray points(array);
  std::vector<double> values(static_cast<std::size_t>(points.size()));
  {
    const py::gil_scoped_release unlocked;
    points.visit([&](const auto& columns) {
      for (Eigen::Index i = 0; i < columns.cols(); ++i) {
        const Eigen::Vector3d p = columns.col(i).template cast<double>();
        values[static_cast<std::size_t>(i)] =
            p.allFinite() ? f(p) : std::numeric_limits<double>::quiet_NaN();
      }
    });
  }
  return valuesLike(points, std::move(values));
}

template <typename Body>
py::object containsOf(const Body& body, const py::object& array) {
  const PointArray points(array);
  // vector<bool> has no memory to hand out
  const auto count = static_cast<std::size_t>(points.size());
  py::array_t<bool> result(points.shape());
  bool* out = result.mutable_data();
  {
    const py::gil_scoped_release unlocked;
    const Eigen::Matrix3Xd columns = points.columns();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d p = columns.col(static_cast<Eigen::Index>(i));
      out[i] = p.allFinite() && body.contains(p);
    }
  }
  return points.shape().empty() ? py::object(py::bool_(out[0])) : py::object(result);
}

/** \brief f of each point, a vector. */
template <typename Function>
py::array_t<double> eachVector(const py::object& array, const Function& f) {
  const PointArray points(array);
  std::vector<py::ssize_t> shape = points.shape();
  shape.push_back(3);
  py::array_t<double> result(shape);
  Eigen::Map<Eigen::Matrix3Xd> out(result.mutable_data(), 3, points.size());
  const py::gil_scoped_release unlocked;
  const Eigen::Matrix3Xd columns = points.columns();
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    out.col(i) = columns.col(i).allFinite() ? f(Eigen::Vector3d(columns.col(i)))
                                            : Eigen::Vector3d::Constant(std::nan(""));
  return result;
}

/** \brief Distances of many points by the kernels; NaN where a coordinate is not
 * finite. */
inline std::vector<double> quickDistances(const Superquadric& body,
                                          const PointArray& points) {
  return points.visit([&](const auto& columns) {
    const Eigen::VectorXd d = surfaceDistances(body, columns);
    std::vector<double> values(d.data(), d.data() + d.size());
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
      if (!columns.col(i).allFinite())
        values[std::size_t(i)] = std::numeric_limits<double>::quiet_NaN();
    return values;
  });
}

template <typename Body>
py::object
distanceOf(const Body& body, const py::object& array, const std::string& method) {
  if (method == "exact")
    return eachPoint(
        array, [&](const Eigen::Vector3d& p) { return body.euclideanDistance(p); });
  if (method != "fast")
    throw std::invalid_argument("method wants 'exact' or 'fast', not '" + method + "'");
  const PointArray points(array);
  std::vector<double> least;
  {
    const py::gil_scoped_release unlocked;
    if constexpr (std::is_same_v<Body, Superquadric>)
      least = quickDistances(body, points);
    else {
      least.assign(std::size_t(points.size()), std::numeric_limits<double>::infinity());
      for (const Superquadric& part : body.parts) {
        const std::vector<double> d = quickDistances(part, points);
        for (std::size_t i = 0; i < d.size(); ++i)
          least[i] = std::isnan(d[i]) ? d[i] : std::min(least[i], d[i]);
      }
    }
  }
  return valuesLike(points, std::move(least));
}

inline Superquadric makeSuperquadric(const Eigen::Vector3d& semi_axes,
                                     const std::array<double, 2>& epsilon,
                                     const Eigen::Vector3d& center,
                                     const Eigen::Matrix3d& rotation,
                                     const std::array<double, 2>& taper,
                                     double rim,
                                     double wall,
                                     const std::array<double, 2>& bend) {
  Superquadric s;
  s.semi_axes = semi_axes;
  s.epsilon1 = epsilon[0];
  s.epsilon2 = epsilon[1];
  s.center = center;
  s.rotation = rotation;
  s.kx = taper[0];
  s.ky = taper[1];
  s.rim = rim;
  s.wall = wall;
  s.bend = bend[0];
  s.bend_angle = bend[1];
  std::string why;
  if (!s.isValid(&why))
    throw std::invalid_argument("this is no superquadric: " + why);
  return s;
}

inline py::tuple boundsOf(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty())
    throw std::invalid_argument("a union without parts has no bounds");
  return py::make_tuple(Eigen::Vector3d(box.min()), Eigen::Vector3d(box.max()));
}

/** \brief Points uniform in area on a body, N x 3. */
inline py::array_t<double>
sampleOf(const Superquadric& body, std::size_t count, unsigned seed) {
  std::vector<double> values;
  {
    const py::gil_scoped_release unlocked;
    const std::vector<Eigen::Vector3d> points = sampleUniform(body, count, seed);
    values.reserve(3 * points.size());
    for (const Eigen::Vector3d& p : points)
      values.insert(values.end(), p.data(), p.data() + 3);
  }
  const auto rows = static_cast<py::ssize_t>(values.size() / 3);
  return ownedArray(std::move(values), {rows, 3});
}

template <typename T>
std::string textOf(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

} // namespace pcl_sq::python
