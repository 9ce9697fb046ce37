// SPDX-License-Identifier: BSD-3-Clause
#include "truth.h"

#include "app.h"
#include "files.h"

#include <nlohmann/json.hpp>

namespace pcl_sq::app {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json rows(const Eigen::Matrix3d& m) {
  Json result = Json::array();
  for (int i = 0; i < 3; ++i)
    result.push_back(toJson(Eigen::Vector3d(m.row(i))));
  return result;
}

template <int N>
Eigen::Matrix<double, N, 1> vectorOf(const Json& json) {
  if (json.size() != static_cast<std::size_t>(N))
    throw Failure("a vector of the truth file has the wrong length.");
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i)
    v[i] = json.at(static_cast<std::size_t>(i)).get<double>();
  return v;
}

Eigen::Matrix3d matrixOf(const Json& json) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    m.row(i) = vectorOf<3>(json.at(static_cast<std::size_t>(i))).transpose();
  return m;
}

} // namespace

std::string toJson(const SceneTruth& t) {
  Json parts = Json::array();
  for (const Superquadric& s : t.parts.parts)
    parts.push_back({{"semi_axes", toJson(s.semi_axes)},
                     {"epsilon", Json::array({s.epsilon1, s.epsilon2})},
                     {"translation", toJson(s.center)},
                     {"rotation", rows(s.rotation)}});
  const Json json = {
      {"schema", "pcl_sq/truth"},
      {"version", 1},
      {"unit", "m"},
      {"frame", "left rectified camera: x right, y down, z forward"},
      {"scene", t.scene},
      {"seed", t.seed},
      {"camera",
       {{"width", t.width},
        {"height", t.height},
        {"f", t.focal_length},
        {"cx", t.cx},
        {"cy", t.cy},
        {"baseline", t.baseline}}},
      {"pose",
       {{"rotation", rows(t.rotation)}, {"translation", toJson(t.translation)}}},
      {"size",
       {{"width", t.size.x()}, {"height", t.size.z()}, {"thickness", t.size.y()}}},
      {"symmetry", toString(t.symmetry)},
      {"mesh", t.mesh},
      {"superquadrics", parts},
      {"table", Json::array({t.table[0], t.table[1], t.table[2], t.table[3]})},
      {"roi", Json::array({t.roi.x, t.roi.y, t.roi.width, t.roi.height})},
      {"visible_pixels", t.visible_pixels}};
  return json.dump(2) + "\n";
}

SceneTruth readTruth(const std::string& path) {
  try {
    const Json json = Json::parse(readFile(path));
    if (json.at("schema") != "pcl_sq/truth" || json.at("version") != 1)
      throw Failure("'" + path + "' is not a truth file of version 1.");
    SceneTruth t;
    t.scene = json.at("scene").get<std::string>();
    t.seed = json.at("seed").get<std::uint64_t>();
    const Json& camera = json.at("camera");
    t.width = camera.at("width").get<int>();
    t.height = camera.at("height").get<int>();
    t.focal_length = camera.at("f").get<double>();
    t.cx = camera.at("cx").get<double>();
    t.cy = camera.at("cy").get<double>();
    t.baseline = camera.at("baseline").get<double>();
    t.rotation = matrixOf(json.at("pose").at("rotation"));
    t.translation = vectorOf<3>(json.at("pose").at("translation"));
    const Json& size = json.at("size");
    t.size = {size.at("width").get<double>(),
              size.at("thickness").get<double>(),
              size.at("height").get<double>()};
    if (!symmetryFromString(json.at("symmetry").get<std::string>(), &t.symmetry))
      throw Failure("'" + path + "' names an unknown symmetry.");
    t.mesh = json.at("mesh").get<std::string>();
    for (const Json& part : json.at("superquadrics")) {
      Superquadric s;
      s.semi_axes = vectorOf<3>(part.at("semi_axes"));
      s.epsilon1 = part.at("epsilon").at(0).get<double>();
      s.epsilon2 = part.at("epsilon").at(1).get<double>();
      s.center = vectorOf<3>(part.at("translation"));
      s.rotation = matrixOf(part.at("rotation"));
      std::string why;
      if (!s.isValid(&why))
        throw Failure("'" + path + "' holds an invalid superquadric: " + why);
      t.parts.parts.push_back(s);
    }
    t.table = vectorOf<4>(json.at("table"));
    const auto roi = vectorOf<4>(json.at("roi"));
    t.roi = {int(roi[0]), int(roi[1]), int(roi[2]), int(roi[3])};
    t.visible_pixels = json.at("visible_pixels").get<std::size_t>();
    return t;
  } catch (const nlohmann::json::exception&) {
    throw Failure("'" + path +
                  "' is not a truth file of pcl_sq_render: it is no JSON, or "
                  "a member is missing or of another type.");
  }
}

} // namespace pcl_sq::app
