// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/scene_io.h"

#include "io/json_text.h"
#include "pcl_sq/file_io.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* SCHEMA = "pcl_sq/scene";
constexpr int VERSION = 1;
constexpr std::size_t MOST_OBJECTS = 65535; ///< as many as labels tell apart

/** \brief Members that an object has besides those of a model file. */
const std::vector<const char*> OWN = {
    "roi", "pixels", "visible", "confidence", "notes"};

/** \brief A refusal with its reason; does not leave this file. */
struct Refusal {
  std::string why;
};

Json parsed(const std::string& text) {
  Json json;
  std::string why;
  if (!detail::parseJson(text, json, &why))
    throw Refusal{why};
  return json;
}

Json timesOf(const std::vector<std::pair<std::string, double>>& timings_ms) {
  Json times = Json::object();
  for (const auto& [stage, ms] : timings_ms)
    if (std::isfinite(ms))
      times[stage] = ms;
  return times;
}

Json toJson(const SceneFileObject& object) {
  Json json = Json::parse(toJson(object.file, -1));
  const CellRect& r = object.roi;
  json["roi"] = {r.x, r.y, r.width, r.height};
  json["pixels"] = object.pixels;
  json["visible"] = object.visible;
  json["confidence"] = object.confidence;
  json["notes"] = object.notes;
  return json;
}

std::string textOf(const Json& json, const char* key) {
  const auto it = json.find(key);
  return it != json.end() && it->is_string() ? it->get<std::string>() : std::string();
}

std::vector<std::string> notesOf(const Json& json) {
  std::vector<std::string> notes;
  if (const auto it = json.find("notes"); it != json.end() && it->is_array())
    for (const Json& note : *it)
      if (note.is_string())
        notes.push_back(note.get<std::string>());
  return notes;
}

double shareOf(const Json& json, const char* key) {
  const auto it = json.find(key);
  const double share = it != json.end() && it->is_number() ? it->get<double>() : 1.0;
  if (!(share >= 0.0 && share <= 1.0))
    throw Refusal{std::string("\"") + key + "\" must lie in 0 to 1"};
  return share;
}

int pixelsOf(const Json& number) {
  const double value = number.is_number() ? number.get<double>() : -1.0;
  if (!(value >= 0.0 && value <= 1e9))
    throw Refusal{"pixels must be whole numbers from 0 on"};
  return int(value);
}

SceneFileObject objectFromJson(Json json) {
  SceneFileObject object;
  if (!json.is_object())
    throw Refusal{"it is no JSON object"};
  if (const auto roi = json.find("roi"); roi != json.end()) {
    if (!roi->is_array() || roi->size() != 4)
      throw Refusal{"\"roi\" must hold 4 numbers"};
    object.roi = {pixelsOf((*roi)[0]),
                  pixelsOf((*roi)[1]),
                  pixelsOf((*roi)[2]),
                  pixelsOf((*roi)[3])};
  }
  if (const auto pixels = json.find("pixels"); pixels != json.end())
    object.pixels = pixelsOf(*pixels);
  object.visible = shareOf(json, "visible");
  object.confidence = shareOf(json, "confidence");
  object.notes = notesOf(json);
  for (const char* key : OWN)
    json.erase(key);
  std::string why;
  if (!fromJson(
          json.dump(-1, ' ', false, Json::error_handler_t::replace), object.file, &why))
    throw Refusal{why};
  if (object.file.model.empty())
    throw Refusal{"it has no superquadric"};
  return object;
}

std::array<double, 4> tableFromJson(const Json& json) {
  std::array<double, 4> table{};
  if (!json.is_array() || json.size() != 4)
    throw Refusal{"\"table\" must hold 4 numbers"};
  for (std::size_t k = 0; k < 4; ++k) {
    if (!json[k].is_number())
      throw Refusal{"\"table\" must hold 4 numbers"};
    table[k] = json[k].get<double>();
  }
  if (!(std::abs(std::hypot(table[0], table[1], table[2]) - 1.0) < 1e-3) ||
      !std::isfinite(table[3]))
    throw Refusal{"the normal of \"table\" must have length one"};
  return table;
}

void readInput(const Json& json, SceneFile& file) {
  const auto input = json.find("input");
  if (input == json.end() || !input->is_object())
    return;
  const auto countOf = [&input](const char* key) -> std::size_t {
    const auto it = input->find(key);
    const double count =
        it != input->end() && it->is_number() ? it->get<double>() : 0.0;
    return count > 0.0 && count < 1e15 ? static_cast<std::size_t>(count) : 0;
  };
  file.input_path = textOf(*input, "path");
  file.input_points = countOf("points");
  file.finite_points = countOf("finite_points");
}

void read(const std::string& text, SceneFile& file) {
  const Json json = parsed(text);
  if (!json.is_object() || textOf(json, "schema") != SCHEMA)
    throw Refusal{"this is not a pcl_sq/scene file"};
  if (!json.contains("version") || json.at("version") != VERSION)
    throw Refusal{"its version is not known, 1 is"};
  if (textOf(json, "unit") != "m")
    throw Refusal{"the unit must be \"m\""};
  if (!json.contains("objects") || !json.at("objects").is_array())
    throw Refusal{"\"objects\" must be a list"};
  const Json& objects = json.at("objects");
  if (objects.size() > MOST_OBJECTS)
    throw Refusal{"it has more than 65535 objects"};
  for (std::size_t k = 0; k < objects.size(); ++k) {
    try {
      file.objects.push_back(objectFromJson(objects[k]));
    } catch (const Refusal& refusal) {
      throw Refusal{"object " + std::to_string(k + 1) + ": " + refusal.why};
    }
  }
  if (const auto table = json.find("table"); table != json.end())
    file.table = tableFromJson(*table);
  file.frame = textOf(json, "frame");
  readInput(json, file);
  if (const auto options = json.find("options"); options != json.end())
    file.options_json = options->dump();
  if (const auto times = json.find("timings_ms");
      times != json.end() && times->is_object())
    for (const auto& [stage, ms] : times->items())
      if (ms.is_number())
        file.timings_ms.emplace_back(stage, ms.get<double>());
  file.notes = notesOf(json);
  static const std::vector<std::string> KNOWN = {"schema",
                                                 "version",
                                                 "unit",
                                                 "frame",
                                                 "table",
                                                 "objects",
                                                 "notes",
                                                 "input",
                                                 "options",
                                                 "timings_ms",
                                                 "generator"};
  Json extra = Json::object();
  for (const auto& [key, value] : json.items())
    if (std::find(KNOWN.begin(), KNOWN.end(), key) == KNOWN.end())
      extra[key] = value;
  file.extra_json = extra.dump();
}

} // namespace

MultiSuperquadric SceneFile::all(std::size_t without) const {
  MultiSuperquadric model;
  for (std::size_t k = 0; k < objects.size(); ++k)
    if (k != without)
      model.parts.insert(model.parts.end(),
                         objects[k].file.model.parts.begin(),
                         objects[k].file.model.parts.end());
  return model;
}

std::string toJson(const SceneFile& file, int indent) {
  Json json = {
      {"schema", SCHEMA}, {"version", VERSION}, {"unit", "m"}, {"frame", file.frame}};
  if (file.table)
    json["table"] = *file.table;
  json["objects"] = Json::array();
  for (const SceneFileObject& object : file.objects)
    json["objects"].push_back(toJson(object));
  json["notes"] = file.notes;
  json["input"] = {{"path", file.input_path},
                   {"points", file.input_points},
                   {"finite_points", file.finite_points}};
  json["options"] = Json::parse(file.options_json);
  json["timings_ms"] = timesOf(file.timings_ms);
  const Json extra = Json::parse(file.extra_json);
  for (const auto& [key, value] : extra.items())
    json[key] = value;
  json["generator"] = "pcl_sq " PCL_SQ_VERSION;
  // a path may hold bytes that are not UTF-8; they become replacement characters
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool isScene(const std::string& text) {
  Json json;
  std::string why;
  return detail::parseJson(text, json, &why) && json.is_object() &&
         textOf(json, "schema") == SCHEMA;
}

bool fromJson(const std::string& text, SceneFile& file, std::string* why) {
  file = {};
  std::string reason;
  try {
    read(text, file);
    return true;
  } catch (const Refusal& refusal) {
    reason = refusal.why;
  } catch (const Json::exception&) {
    reason = "not valid JSON of a scene: a member is of another type";
  }
  file = {};
  if (why)
    *why = reason;
  return false;
}

bool saveScene(const std::string& path, const SceneFile& file, std::string* why) {
  return writeFile(path, toJson(file) + "\n", why);
}

bool loadScene(const std::string& path, SceneFile& file, std::string* why) {
  file = {};
  std::string text, reason;
  if (!readFile(path, text, why))
    return false;
  if (fromJson(text, file, &reason))
    return true;
  if (why)
    *why = "'" + path + "' is no scene file: " + reason;
  return false;
}

} // namespace pcl_sq
