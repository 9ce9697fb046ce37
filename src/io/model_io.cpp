// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/model_io.h"

#include "io/json_members.h"

#include <algorithm>

namespace pcl_sq {

using namespace detail;

namespace {

constexpr const char* MODEL_SCHEMA = "pcl_sq/model";
constexpr int MODEL_VERSION = 1;
constexpr int TAPERED_VERSION = 2;
constexpr int OPEN_VERSION = 3; ///< rims, walls, bends and tables

/** \brief What a model is for is few bodies; a union's surface, its mass and its grasps
 * compare every pair of them. */
constexpr std::size_t MOST_PARTS = 1000;

Json partToJson(const Superquadric& s, const PartStatistics& statistics) {
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row)
    rotation.push_back(vectorToJson(s.rotation.row(row)));
  Json json = {{"semi_axes", vectorToJson(s.semi_axes)},
               {"epsilon", {s.epsilon1, s.epsilon2}},
               {"translation", vectorToJson(s.center)},
               {"rotation", rotation}};
  if (s.isTapered())
    json["taper"] = {s.kx, s.ky};
  if (s.isBent())
    json["bend"] = {s.bend, s.bend_angle};
  if (s.rim < 1.0)
    json["rim"] = s.rim;
  if (s.isHollow())
    json["wall"] = s.wall;
  json["points"] = statistics.points;
  addFinite(json, "distortion", statistics.distortion);
  addFinite(json, "rms_distance", statistics.rms_distance);
  json["termination"] = statistics.termination;
  return json;
}

double number(const Json& part, const char* key) {
  if (!part.at(key).is_number())
    throw Refusal{std::string("\"") + key + "\" must be a number"};
  return part.at(key).get<double>();
}

Superquadric partFromJson(const Json& part, std::size_t index, int version) {
  Superquadric s;
  s.semi_axes = numbers<3>(member(part, "semi_axes"), "semi_axes");
  const Eigen::Matrix<double, 2, 1> epsilon =
      numbers<2>(member(part, "epsilon"), "epsilon");
  s.epsilon1 = epsilon[0];
  s.epsilon2 = epsilon[1];
  s.center = numbers<3>(member(part, "translation"), "translation");
  const Json& rotation = member(part, "rotation");
  if (!rotation.is_array() || rotation.size() != 3)
    throw Refusal{"\"rotation\" must hold three rows"};
  for (int row = 0; row < 3; ++row)
    s.rotation.row(row) = numbers<3>(rotation[row], "rotation");
  if (version >= TAPERED_VERSION && part.contains("taper")) {
    const Eigen::Matrix<double, 2, 1> taper = numbers<2>(part.at("taper"), "taper");
    s.kx = taper[0];
    s.ky = taper[1];
  }
  if (version >= OPEN_VERSION) {
    if (part.contains("rim"))
      s.rim = number(part, "rim");
    if (part.contains("wall"))
      s.wall = number(part, "wall");
    if (part.contains("bend")) {
      const Eigen::Matrix<double, 2, 1> bend = numbers<2>(part.at("bend"), "bend");
      s.bend = bend[0];
      s.bend_angle = bend[1];
    }
  }
  std::string why;
  if (!s.isValid(&why))
    throw Refusal{"superquadric " + std::to_string(index) + ": " + why};
  return s;
}

/** \brief The version, if it is one that is known. */
int versionFromJson(const Json& json) {
  const Json& version = member(json, "version");
  if (!version.is_number_integer())
    throw Refusal{"\"version\" is not a whole number"};
  const auto number = version.get<long long>();
  if (number < MODEL_VERSION || number > OPEN_VERSION)
    throw Refusal{"version " + version.dump() +
                  " of the schema is not known, 1 to 3 are"};
  return static_cast<int>(number);
}

} // namespace

Json detail::modelToJson(const ModelFile& file) {
  Json parts = Json::array();
  for (std::size_t i = 0; i < file.model.size(); ++i)
    parts.push_back(
        partToJson(file.model.parts[i],
                   i < file.statistics.size() ? file.statistics[i] : PartStatistics()));
  const auto any = [&file](auto of_kind) {
    return std::any_of(file.model.parts.begin(), file.model.parts.end(), of_kind);
  };
  const bool tapered = any([](const Superquadric& s) { return s.isTapered(); });
  const bool open = any([](const Superquadric& s) { return s.isCut() || s.isBent(); });
  Json json = {{"schema", MODEL_SCHEMA},
               {"version",
                file.table || open ? OPEN_VERSION
                : tapered          ? TAPERED_VERSION
                                   : MODEL_VERSION},
               {"unit", "m"},
               {"frame", file.frame},
               {"superquadrics", parts}};
  addFinite(json, "distortion", file.distortion);
  addFinite(json, "rms_distance", file.rms_distance);
  addCommon(file, json);
  return json;
}

void detail::readModel(const Json& json, ModelFile& file) {
  checkHead(json, MODEL_SCHEMA);
  const int version = versionFromJson(json);
  const Json& parts = member(json, "superquadrics");
  if (!parts.is_array())
    throw Refusal{"\"superquadrics\" must be a list"};
  if (parts.size() > MOST_PARTS)
    throw Refusal{std::to_string(parts.size()) + " superquadrics are more than the " +
                  std::to_string(MOST_PARTS) + " that a model may have"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    file.model.parts.push_back(partFromJson(parts[i], i, version));
    file.statistics.push_back({optionalCount(parts[i], "points"),
                               optionalNumber(parts[i], "distortion"),
                               optionalNumber(parts[i], "rms_distance"),
                               optionalString(parts[i], "termination")});
  }
  std::vector<std::string> known = {"superquadrics", "distortion", "rms_distance"};
  if (version == OPEN_VERSION && json.contains("table")) {
    file.table = tableFromJson(json.at("table"));
    known.emplace_back("table");
  }
  file.distortion = optionalNumber(json, "distortion");
  file.rms_distance = optionalNumber(json, "rms_distance");
  readCommon(json, known, file);
}

std::string toJson(const ModelFile& file, int indent) {
  return textOf(modelToJson(file), indent);
}

bool fromJson(const std::string& text, ModelFile& file, std::string* why) {
  return readText(text, "a model", readModel, file, why);
}

bool saveModel(const std::string& path, const ModelFile& file, std::string* why) {
  return saveFile(path, "model", file, why);
}

bool loadModel(const std::string& path, ModelFile& file, std::string* why) {
  return loadFile(path, "model", file, why);
}

} // namespace pcl_sq
