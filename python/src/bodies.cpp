// SPDX-License-Identifier: BSD-3-Clause
// One superquadric, several, and the fit of one to points.
#include "bodies.h"

#include "each_point.h"

#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/fit_tapered.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/sides.h"

#include <pybind11/operators.h>

#include <limits>
#include <sstream>

namespace pcl_sq::python {

namespace {

void addSuperquadric(py::module_& module) {
  using S = Superquadric;
  py::class_<S>(module, "Superquadric", "A superquadric; lengths in metres.")
      .def(py::init(&makeSuperquadric),
           py::arg("semi_axes"),
           py::kw_only(),
           py::arg("epsilon") = std::array<double, 2>{1.0, 1.0},
           py::arg("center") = Eigen::Vector3d(Eigen::Vector3d::Zero()),
           py::arg("rotation") = Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
           py::arg("taper") = std::array<double, 2>{0.0, 0.0},
           py::arg("rim") = 1.0,
           py::arg("wall") = 0.0,
           py::arg("bend") = std::array<double, 2>{0.0, 0.0},
           "Semi-axes [m], exponents, centre [m], axes as columns, taper, rim, wall, "
           "bend.")
      .def_property_readonly(
          "center", [](const S& s) { return s.center; }, "Centre [m].")
      .def_property_readonly(
          "rotation", [](const S& s) { return s.rotation; }, "Axes as columns.")
      .def_property_readonly(
          "semi_axes", [](const S& s) { return s.semi_axes; }, "a1, a2, a3 [m].")
      .def_property_readonly(
          "epsilon",
          [](const S& s) { return py::make_tuple(s.epsilon1, s.epsilon2); },
          "Exponents e1 along z and e2 across it.")
      .def_property_readonly(
          "taper",
          [](const S& s) { return py::make_tuple(s.kx, s.ky); },
          "Relative growth of the section from z = 0 to z = a3.")
      .def_readonly("rim", &S::rim, "Height of the rim over a3; 1: not cut.")
      .def_readonly(
          "wall", &S::wall, "Thickness of a hollow body's wall [m]; 0: solid.")
      .def_property_readonly(
          "bend",
          [](const S& s) { return py::make_tuple(s.bend, s.bend_angle); },
          "Curvature of the z axis [1/m] and its direction in the xy plane [rad].")
      .def_property_readonly("sides", &sidesOf, "Sides that a ruler measures [m].")
      .def_property_readonly("volume", &S::volume, "Filled up to the rim [m^3].")
      .def_property_readonly(
          "bounds",
          [](const S& s) { return boundsOf(s.boundingBox()); },
          "Corners of the axis-aligned box [m].")
      .def(
          "distance",
          &distanceOf<S>,
          py::arg("points"),
          py::kw_only(),
          py::arg("method") = "exact",
          "Signed distance of each point to the surface [m], negative inside.\n\n"
          "'exact' is Euclidean; 'fast' is some fifty times quicker and a few per cent "
          "larger far from the surface.")
      .def("contains", &containsOf<S>, py::arg("points"), "Whether points lie inside.")
      .def(
          "gauge",
          [](const S& s, const py::object& points) {
            return eachPoint(points,
                             [&](const Eigen::Vector3d& p) { return s.gauge(p); });
          },
          py::arg("points"),
          "F^(e1/2): below 1 inside, 1 on the surface.")
      .def(
          "closest_point",
          [](const S& s, const py::object& points) {
            return eachVector(
                points, [&](const Eigen::Vector3d& p) { return s.closestPoint(p); });
          },
          py::arg("points"),
          "The surface's closest point to each.")
      .def(
          "normal",
          [](const S& s, const py::object& points) {
            return eachVector(points,
                              [&](const Eigen::Vector3d& p) { return s.normal(p); });
          },
          py::arg("points"),
          "Outward unit normal of the level surface through each point.")
      .def(
          "mesh",
          [](const S& s, int divisions) {
            if (divisions < 2 || divisions > 1000)
              throw std::invalid_argument("divisions wants 2 to 1000");
            TriangleMesh mesh;
            {
              const py::gil_scoped_release unlocked;
              mesh = meshSuperquadric(s, divisions);
            }
            return meshToPython(mesh);
          },
          py::arg("divisions") = 24,
          "The closed surface as a Mesh.")
      .def("sample",
           &sampleOf,
           py::arg("count"),
           py::arg("seed") = 0,
           "Points uniform in area on the surface, N x 3.")
      .def(py::pickle(
          [](const S& s) {
            return py::make_tuple(s.semi_axes,
                                  std::array<double, 2>{s.epsilon1, s.epsilon2},
                                  s.center,
                                  s.rotation,
                                  std::array<double, 2>{s.kx, s.ky},
                                  s.rim,
                                  s.wall,
                                  std::array<double, 2>{s.bend, s.bend_angle});
          },
          [](const py::tuple& t) {
            return makeSuperquadric(t[0].cast<Eigen::Vector3d>(),
                                    t[1].cast<std::array<double, 2>>(),
                                    t[2].cast<Eigen::Vector3d>(),
                                    t[3].cast<Eigen::Matrix3d>(),
                                    t[4].cast<std::array<double, 2>>(),
                                    t[5].cast<double>(),
                                    t[6].cast<double>(),
                                    t[7].cast<std::array<double, 2>>());
          }))
      .def("__repr__", [](const S& s) { return "<" + textOf(s) + ">"; });
}

py::object nearestParts(const MultiSuperquadric& model, const py::object& array) {
  if (model.empty())
    throw std::invalid_argument("a union without parts has no nearest one");
  const PointArray points(array);
  std::vector<std::int64_t> parts(std::size_t(points.size()));
  {
    const py::gil_scoped_release unlocked;
    const Eigen::Matrix3Xd columns = points.columns();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Eigen::Vector3d p = columns.col(Eigen::Index(i));
      parts[i] = p.allFinite() ? std::int64_t(model.nearestPart(p)) : -1;
    }
  }
  return valuesLike(points, std::move(parts));
}

void addUnion(py::module_& module) {
  using M = MultiSuperquadric;
  py::class_<M>(module, "MultiSuperquadric", "A union of superquadrics.")
      .def(py::init([](const std::vector<Superquadric>& parts) { return M{parts}; }),
           py::arg("parts"))
      .def_readonly("parts", &M::parts, "Its superquadrics.")
      .def("__len__", &M::size)
      .def("__getitem__",
           [](const M& m, std::ptrdiff_t i) {
             const auto n = std::ptrdiff_t(m.size());
             if (i < -n || i >= n)
               throw py::index_error("the union has " + std::to_string(n) + " parts");
             return m.parts[std::size_t(i < 0 ? i + n : i)];
           })
      .def("distance",
           &distanceOf<M>,
           py::arg("points"),
           py::kw_only(),
           py::arg("method") = "exact",
           "Signed distance of each point to the nearest part [m].")
      .def("contains",
           &containsOf<M>,
           py::arg("points"),
           "Whether points lie in a part.")
      .def("nearest_part",
           &nearestParts,
           py::arg("points"),
           "Index of the part whose surface is nearest; -1 of a point that is not "
           "finite.")
      .def(
          "mesh",
          [](const M& m, int resolution) {
            if (resolution < 8 || resolution > 1024)
              throw std::invalid_argument("resolution wants 8 to 1024");
            TriangleMesh mesh;
            {
              const py::gil_scoped_release unlocked;
              mesh = m.meshUnion(resolution);
            }
            return meshToPython(mesh);
          },
          py::arg("resolution") = 96,
          "Closed surface of the union, inner walls removed; cells along its longest "
          "side.")
      .def_property_readonly(
          "bounds",
          [](const M& m) { return boundsOf(m.boundingBox()); },
          "Corners of the axis-aligned box [m].")
      .def_property_readonly(
          "volume",
          [](const M& m) { return massProperties(m).volume; },
          "Of the material, shared space once [m^3].")
      .def(py::pickle(
          [](const M& m) { return py::make_tuple(m.parts); },
          [](const py::tuple& t) { return M{t[0].cast<std::vector<Superquadric>>()}; }))
      .def("__repr__", [](const M& m) { return "<" + textOf(m) + ">"; });
}

py::dict fitOne(const py::object& array,
                const std::optional<Superquadric>& initial,
                bool taper,
                const FitOptions& options) {
  const PointArray points(array);
  std::string why;
  if (!options.isValid(&why))
    throw std::invalid_argument(why);
  if (taper && initial)
    throw std::invalid_argument("taper searches its own start; leave out initial");
  FitSummary fit;
  Superquadric model;
  {
    const py::gil_scoped_release unlocked;
    if (taper) {
      const TaperedFit tapered = fitTapered(points.columns(), options);
      fit = tapered.untapered;
      model = tapered.model;
      fit.rms_distance = tapered.rms_distance;
      fit.sigma = tapered.sigma;
      fit.outlier_share = tapered.outlier_share;
    } else {
      fit = points.visit([&](const auto& columns) {
        return initial ? fitSuperquadric(columns, *initial, options)
                       : fitSuperquadric(columns, options);
      });
      model = fit.model;
    }
  }
  if (!fit.ok())
    return py::dict(py::arg("ok") = false,
                    py::arg("termination") = toString(fit.termination));
  return py::dict(py::arg("ok") = true,
                  py::arg("superquadric") = model,
                  py::arg("termination") = toString(fit.termination),
                  py::arg("points") = fit.points,
                  py::arg("iterations") = fit.iterations,
                  py::arg("rms_distance") = fit.rms_distance,
                  py::arg("sigma") = fit.sigma,
                  py::arg("outlier_share") = fit.outlier_share,
                  py::arg("covariance") = Eigen::MatrixXd(fit.covariance));
}

} // namespace

void addBodies(py::module_& module) {
  addSuperquadric(module);
  addUnion(module);
  module.def(
      "fit_superquadric",
      [](const py::object& points,
         const std::optional<Superquadric>& initial,
         bool taper,
         double noise,
         bool robust,
         double max_outlier_share,
         double min_epsilon,
         double max_epsilon) {
        FitOptions options;
        options.noise = noise;
        options.robust = robust;
        options.max_outlier_share = max_outlier_share;
        options.min_epsilon = min_epsilon;
        options.max_epsilon = max_epsilon;
        return fitOne(points, initial, taper, options);
      },
      py::arg("points"),
      py::arg("initial"),
      py::arg("taper"),
      py::arg("noise"),
      py::arg("robust"),
      py::arg("max_outlier_share"),
      py::arg("min_epsilon"),
      py::arg("max_epsilon"));
}

} // namespace pcl_sq::python
