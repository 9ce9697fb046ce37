// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_members.h"

#include <cmath>

namespace pcl_sq::detail {

const Json& member(const Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    throw Refusal{std::string("the member \"") + key + "\" is missing"};
  return object.at(key);
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

std::vector<std::string> optionalStrings(const Json& object, const char* key) {
  std::vector<std::string> strings;
  if (const auto it = object.find(key); it != object.end() && it->is_array())
    for (const Json& string : *it)
      if (string.is_string())
        strings.push_back(string.get<std::string>());
  return strings;
}

void addFinite(Json& object, const char* key, double number) {
  if (std::isfinite(number))
    object[key] = number;
}

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

void checkHead(const Json& json, const std::string& schema) {
  if (!json.is_object() || optionalString(json, "schema") != schema)
    throw Refusal{"this is not a " + schema + " file"};
  if (optionalString(json, "unit") != "m")
    throw Refusal{"the unit must be \"m\""};
}

std::vector<std::pair<std::string, double>> timesFromJson(const Json& json) {
  std::vector<std::pair<std::string, double>> times;
  if (const auto it = json.find("timings_ms"); it != json.end() && it->is_object())
    for (const auto& [stage, ms] : it->items())
      if (ms.is_number())
        times.emplace_back(stage, ms.get<double>());
  return times;
}

Json jsonOf(const std::string& text, const char* name) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    throw Exception(std::string(name) + " is no JSON");
  return json;
}

std::string textOf(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace pcl_sq::detail
