// SPDX-License-Identifier: BSD-3-Clause
#include "scene/truth.h"

#include "command_line/app.h"
#include "files/files.h"
#include "io/json_text.h"

#include <Eigen/LU>
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

/** \brief Takes members out of a truth file; a Failure names the one that is wrong. */
class Members {
public:
  Members(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  Members at(const char* key) const {
    if (!json_.is_object() || !json_.contains(key))
      refuse(std::string("has no member \"") + key + "\"");
    return {json_.at(key), path_};
  }
  std::string text(const char* key) const {
    const Json& value = at(key).json_;
    if (!value.is_string())
      refuse(std::string("\"") + key + "\" is no text");
    return value.get<std::string>();
  }
  double number(const char* key, double low = -1e20, double high = 1e20) const {
    return at(key).value(key, low, high);
  }
  template <int N>
  Eigen::Matrix<double, N, 1>
  vector(const char* key, double low = -1e20, double high = 1e20) const {
    return at(key).values<N>(key, low, high);
  }
  Eigen::Matrix3d rotation() const {
    const Members rows = at("rotation");
    Eigen::Matrix3d m;
    if (!rows.json_.is_array() || rows.json_.size() != 3)
      refuse("\"rotation\" must hold three rows");
    for (std::size_t i = 0; i < 3; ++i)
      m.row(Eigen::Index(i)) =
          Members(rows.json_[i], path_).values<3>("rotation", -2.0, 2.0).transpose();
    const Eigen::Matrix3d skew = m * m.transpose() - Eigen::Matrix3d::Identity();
    if (!(skew.cwiseAbs().maxCoeff() < 1e-4) || m.determinant() < 0.0)
      refuse("\"rotation\" is not a rotation");
    return m;
  }
  const Json& json() const { return json_; }
  [[noreturn]] void refuse(const std::string& what) const {
    throw Failure("'" + path_ + "' is not a truth file of pcl_sq_render: " + what +
                  ".");
  }

private:
  double value(const char* key, double low, double high) const {
    const double x = json_.is_number() ? json_.get<double>() : low - 1.0;
    if (!(x >= low && x <= high))
      refuse(std::string("\"") + key + "\" is no number within its range");
    return x;
  }
  template <int N>
  Eigen::Matrix<double, N, 1> values(const char* key, double low, double high) const {
    if (!json_.is_array() || json_.size() != static_cast<std::size_t>(N))
      refuse(std::string("\"") + key + "\" must hold " + std::to_string(N) +
             " numbers");
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i)
      v[i] = Members(json_[static_cast<std::size_t>(i)], path_).value(key, low, high);
    return v;
  }

  const Json& json_;
  std::string path_;
};

/** \brief Largest number of pixels along a side, and in an image. */
constexpr double MOST_PIXELS = 1e6, MOST_IN_IMAGE = 1e12;

Superquadric partOf(const Members& part) {
  Superquadric s;
  s.semi_axes = part.vector<3>("semi_axes");
  const Eigen::Vector2d epsilon = part.vector<2>("epsilon");
  s.epsilon1 = epsilon[0];
  s.epsilon2 = epsilon[1];
  s.center = part.vector<3>("translation");
  s.rotation = part.rotation();
  std::string why;
  if (!s.isValid(&why))
    part.refuse("a superquadric is not valid: " + why);
  return s;
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
  return truthFromJson(readFile(path), path);
}

SceneTruth truthFromJson(const std::string& text, const std::string& path) {
  Json json;
  const Members root(json, path);
  std::string why;
  if (!detail::parseJson(text, json, &why))
    root.refuse(why);
  if (root.text("schema") != "pcl_sq/truth" || root.number("version") != 1.0)
    root.refuse("it is of another schema or version");
  SceneTruth t;
  t.scene = root.text("scene");
  if (!root.at("seed").json().is_number_unsigned())
    root.refuse("\"seed\" is no whole number");
  t.seed = root.at("seed").json().get<std::uint64_t>();
  const Members camera = root.at("camera");
  t.width = static_cast<int>(camera.number("width", 1, MOST_PIXELS));
  t.height = static_cast<int>(camera.number("height", 1, MOST_PIXELS));
  t.focal_length = camera.number("f", 1e-3);
  t.cx = camera.number("cx");
  t.cy = camera.number("cy");
  t.baseline = camera.number("baseline");
  t.rotation = root.at("pose").rotation();
  t.translation = root.at("pose").vector<3>("translation");
  const Members size = root.at("size");
  t.size = {
      size.number("width", 0), size.number("thickness", 0), size.number("height", 0)};
  if (!symmetryFromString(root.text("symmetry"), &t.symmetry))
    root.refuse("\"symmetry\" is not known");
  t.mesh = root.text("mesh");
  for (const Json& part : root.at("superquadrics").json())
    t.parts.parts.push_back(partOf(Members(part, path)));
  t.table = root.vector<4>("table");
  const auto roi = root.vector<4>("roi", -MOST_PIXELS, MOST_PIXELS);
  t.roi = {int(roi[0]), int(roi[1]), int(roi[2]), int(roi[3])};
  t.visible_pixels =
      static_cast<std::size_t>(root.number("visible_pixels", 0, MOST_IN_IMAGE));
  return t;
}

} // namespace pcl_sq::app
