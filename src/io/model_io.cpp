// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/model_io.h"

#include "io/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace {

// The schema's order of members is kept: people read these files.
using Json = nlohmann::ordered_json;

constexpr const char* SCHEMA = "pcl_sq/model";
constexpr int VERSION = 1;
constexpr int TAPERED_VERSION = 2;
constexpr int OPEN_VERSION = 3; ///< rims, walls, bends and tables

Json vectorToJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/** \brief Adds a number; one that is not finite is left out, for JSON has no word for
 * it and readers take what is missing for unknown. */
void addFinite(Json& object, const char* key, double number) {
  if (std::isfinite(number))
    object[key] = number;
}

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

/** \brief A refusal with its reason; does not leave this file. */
struct Refusal {
  std::string why;
};

const Json& member(const Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    throw Refusal{std::string("the member \"") + key + "\" is missing"};
  return object.at(key);
}

template <int N>
Eigen::Matrix<double, N, 1> numbers(const Json& array, const char* name) {
  if (!array.is_array() || array.size() != N)
    throw Refusal{std::string("\"") + name + "\" must hold " + std::to_string(N) +
                  " numbers"};
  Eigen::Matrix<double, N, 1> v;
  for (int k = 0; k < N; ++k) {
    if (!array[k].is_number())
      throw Refusal{std::string("\"") + name + "\" must hold " + std::to_string(N) +
                    " numbers"};
    v[k] = array[k].get<double>();
  }
  return v;
}

double optionalNumber(const Json& object, const char* key) {
  const auto it = object.find(key);
  const double number = it != object.end() && it->is_number() ? it->get<double>() : 0.0;
  if (!(std::abs(number) <= 1e20)) // as the model's own sizes
    throw Refusal{std::string("\"") + key + "\" is larger than 1e20"};
  return number;
}

std::size_t optionalCount(const Json& object, const char* key) {
  const double count = optionalNumber(object, key);
  return count > 0.0 && count < 1e15 ? static_cast<std::size_t>(count) : 0;
}

std::string optionalString(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
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
  if (number < VERSION || number > OPEN_VERSION)
    throw Refusal{"version " + version.dump() +
                  " of the schema is not known, 1 to 3 are"};
  return static_cast<int>(number);
}

/** \brief The table; its normal comes out of unit length. */
std::array<double, 4> tableFromJson(const Json& json) {
  const Eigen::Vector4d table = numbers<4>(json, "table");
  const double length = table.head<3>().norm();
  if (!table.allFinite() || !(std::abs(length - 1.0) < 1e-3))
    throw Refusal{"the normal of \"table\" must have length one"};
  // what was written comes back to the bit
  const bool exact = std::abs(length - 1.0) < 1e-12;
  const Eigen::Vector4d t = exact ? table : Eigen::Vector4d(table / length);
  return {t[0], t[1], t[2], t[3]};
}

void read(const std::string& text, ModelFile& file) {
  Json json;
  std::string why;
  if (!detail::parseJson(text, json, &why))
    throw Refusal{why};
  if (!json.is_object() || optionalString(json, "schema") != SCHEMA)
    throw Refusal{"this is not a pcl_sq/model file"};
  const int version = versionFromJson(json);
  if (optionalString(json, "unit") != "m")
    throw Refusal{"the unit must be \"m\""};
  const Json& parts = member(json, "superquadrics");
  if (!parts.is_array())
    throw Refusal{"\"superquadrics\" must be a list"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    file.model.parts.push_back(partFromJson(parts[i], i, version));
    file.statistics.push_back({optionalCount(parts[i], "points"),
                               optionalNumber(parts[i], "distortion"),
                               optionalNumber(parts[i], "rms_distance"),
                               optionalString(parts[i], "termination")});
  }
  if (version == OPEN_VERSION && json.contains("table"))
    file.table = tableFromJson(json.at("table"));
  file.frame = optionalString(json, "frame");
  file.distortion = optionalNumber(json, "distortion");
  file.rms_distance = optionalNumber(json, "rms_distance");
  if (const auto input = json.find("input");
      input != json.end() && input->is_object()) {
    file.input_path = optionalString(*input, "path");
    file.input_points = optionalCount(*input, "points");
    file.finite_points = optionalCount(*input, "finite_points");
  }
  if (const auto options = json.find("options"); options != json.end())
    file.options_json = options->dump();
  if (const auto times = json.find("timings_ms");
      times != json.end() && times->is_object())
    for (const auto& [stage, ms] : times->items())
      if (ms.is_number())
        file.timings_ms.emplace_back(stage, ms.get<double>());
  Json extra = Json::object();
  for (const auto& [key, value] : json.items()) {
    if (key == "table" && file.table)
      continue;
    static const std::vector<std::string> KNOWN = {"schema",
                                                   "version",
                                                   "unit",
                                                   "frame",
                                                   "superquadrics",
                                                   "distortion",
                                                   "rms_distance",
                                                   "input",
                                                   "options",
                                                   "timings_ms",
                                                   "generator"};
    if (std::find(KNOWN.begin(), KNOWN.end(), key) == KNOWN.end())
      extra[key] = value;
  }
  file.extra_json = extra.dump();
}

} // namespace

std::string toJson(const ModelFile& file, int indent) {
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
  Json timings = Json::object();
  for (const auto& [stage, ms] : file.timings_ms)
    addFinite(timings, stage.c_str(), ms);
  Json json = {{"schema", SCHEMA},
               {"version",
                file.table || open ? OPEN_VERSION
                : tapered          ? TAPERED_VERSION
                                   : VERSION},
               {"unit", "m"},
               {"frame", file.frame},
               {"superquadrics", parts}};
  addFinite(json, "distortion", file.distortion);
  addFinite(json, "rms_distance", file.rms_distance);
  json["input"] = {{"path", file.input_path},
                   {"points", file.input_points},
                   {"finite_points", file.finite_points}};
  json["options"] = Json::parse(file.options_json);
  json["timings_ms"] = timings;
  if (file.table)
    json["table"] = *file.table;
  const Json extra = Json::parse(file.extra_json);
  for (const auto& [key, value] : extra.items())
    json[key] = value;
  json["generator"] = "pcl_sq " PCL_SQ_VERSION;
  // a path may hold bytes that are not UTF-8; they become replacement characters
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool fromJson(const std::string& text, ModelFile& file, std::string* why) {
  file = {};
  try {
    read(text, file);
    return true;
  } catch (const Refusal& refusal) {
    if (why)
      *why = refusal.why;
  } catch (const Json::parse_error& error) {
    if (why)
      *why = "not valid JSON, at byte " + std::to_string(error.byte);
  } catch (const Json::exception&) {
    if (why)
      *why = "not valid JSON of a model: a member is of another type";
  }
  file = {};
  return false;
}

} // namespace pcl_sq
