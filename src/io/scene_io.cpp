// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/scene_io.h"

#include "io/json_members.h"

namespace pcl_sq {

using namespace detail;

namespace {

constexpr const char* SCENE_SCHEMA = "pcl_sq/scene";
constexpr int SCENE_VERSION = 1;
constexpr std::size_t MOST_OBJECTS = 65535; ///< as many as labels tell apart

/** \brief Members that an object has besides those of a model file. */
const std::vector<const char*> OWN = {
    "roi", "pixels", "visible", "confidence", "notes"};

Json toJson(const SceneFileObject& object) {
  Json json = modelToJson(object.file);
  const CellRect& r = object.roi;
  json["roi"] = {r.x, r.y, r.width, r.height};
  json["pixels"] = object.pixels;
  json["visible"] = object.visible;
  json["confidence"] = object.confidence;
  json["notes"] = object.notes;
  return json;
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
  object.notes = optionalStrings(json, "notes");
  for (const char* key : OWN)
    json.erase(key);
  readModel(json, object.file);
  if (object.file.model.empty())
    throw Refusal{"it has no superquadric"};
  return object;
}

void read(const Json& json, SceneFile& file) {
  checkHead(json, SCENE_SCHEMA);
  if (!json.contains("version") || json.at("version") != SCENE_VERSION)
    throw Refusal{"its version is not known, 1 is"};
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
  file.notes = optionalStrings(json, "notes");
  readCommon(json, {"table", "objects", "notes"}, file);
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
  Json json = {{"schema", SCENE_SCHEMA},
               {"version", SCENE_VERSION},
               {"unit", "m"},
               {"frame", file.frame}};
  if (file.table)
    json["table"] = *file.table;
  json["objects"] = Json::array();
  for (const SceneFileObject& object : file.objects)
    json["objects"].push_back(toJson(object));
  json["notes"] = file.notes;
  addCommon(file, json);
  return textOf(json, indent);
}

bool isScene(const std::string& text) {
  Json json;
  std::string why;
  return parseJson(text, json, &why) && json.is_object() &&
         optionalString(json, "schema") == SCENE_SCHEMA;
}

bool fromJson(const std::string& text, SceneFile& file, std::string* why) {
  return readText(text, "a scene", read, file, why);
}

bool saveScene(const std::string& path, const SceneFile& file, std::string* why) {
  return saveFile(path, "scene", file, why);
}

bool loadScene(const std::string& path, SceneFile& file, std::string* why) {
  return loadFile(path, "scene", file, why);
}

} // namespace pcl_sq
