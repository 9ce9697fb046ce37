// SPDX-License-Identifier: BSD-3-Clause
// Private. Members of model and scene files, with a sentence for what is wrong.
#pragma once

#include "io/json_text.h"
#include "pcl_sq/config.h"
#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"
#include "pcl_sq/model_io.h"

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::detail {

/** \brief A refusal with its reason; does not leave this folder. */
struct Refusal {
  std::string why;
};

/** \throw Refusal where it is missing */
const Json& member(const Json& object, const char* key);

/** \brief A list of as many finite numbers. \throw Refusal */
template <int N>
Eigen::Matrix<double, N, 1> numbers(const Json& array, const char* name) {
  const auto refuse = [name] {
    return Refusal{std::string("\"") + name + "\" must hold " + std::to_string(N) +
                   " numbers"};
  };
  if (!array.is_array() || array.size() != N)
    throw refuse();
  Eigen::Matrix<double, N, 1> v;
  for (int k = 0; k < N; ++k) {
    if (!array[k].is_number())
      throw refuse();
    v[k] = array[k].get<double>();
  }
  return v;
}

/** \brief Zero where there is no number. \throw Refusal beyond 1e20 */
double optionalNumber(const Json& object, const char* key);

/** \brief Zero where there is no count. \throw Refusal beyond 1e20 */
std::size_t optionalCount(const Json& object, const char* key);

/** \brief Empty where there is no text. */
std::string optionalString(const Json& object, const char* key);

/** \brief The texts of a list; none where there is no list. */
std::vector<std::string> optionalStrings(const Json& object, const char* key);

/** \brief Adds a number; one that is not finite is left out, for JSON has no word for
 * it and readers take what is missing for unknown. */
void addFinite(Json& object, const char* key, double number);

/** \brief A table's plane; its normal comes out of unit length. \throw Refusal */
std::array<double, 4> tableFromJson(const Json& json);

/** \brief Refuses what is not of this schema or not in metres. \throw Refusal */
void checkHead(const Json& json, const std::string& schema);

/** \brief Stages and their times [ms]. */
std::vector<std::pair<std::string, double>> timesFromJson(const Json& json);

/** \brief A model file without text around it. */
Json modelToJson(const ModelFile& file);

/** \brief Reads a model file's members. \throw Refusal, Json::exception */
void readModel(const Json& json, ModelFile& file);

/** \brief Reads what model and scene files say alike: frame, input, options, times, and
 * what is none of the members that are known. */
template <class File>
void readCommon(const Json& json, const std::vector<std::string>& known, File& file) {
  file.frame = optionalString(json, "frame");
  if (const auto input = json.find("input");
      input != json.end() && input->is_object()) {
    file.input_path = optionalString(*input, "path");
    file.input_points = optionalCount(*input, "points");
    file.finite_points = optionalCount(*input, "finite_points");
  }
  if (const auto options = json.find("options"); options != json.end())
    file.options_json = options->dump();
  file.timings_ms = timesFromJson(json);
  static const std::vector<std::string> COMMON = {"schema",
                                                  "version",
                                                  "unit",
                                                  "frame",
                                                  "input",
                                                  "options",
                                                  "timings_ms",
                                                  "generator"};
  const auto isOneOf = [](const std::vector<std::string>& names,
                          const std::string& key) {
    return std::find(names.begin(), names.end(), key) != names.end();
  };
  Json extra = Json::object();
  for (const auto& [key, value] : json.items())
    if (!isOneOf(COMMON, key) && !isOneOf(known, key))
      extra[key] = value;
  file.extra_json = extra.dump();
}

/** \brief The JSON of a text that a user hands over. \param[in] name the member that
 * the text is \throw Exception if it is none */
Json jsonOf(const std::string& text, const char* name);

/** \brief Writes what readCommon() reads but the frame. \throw Exception if options or
 * extra members are no JSON */
template <class File>
void addCommon(const File& file, Json& json) {
  json["input"] = {{"path", file.input_path},
                   {"points", file.input_points},
                   {"finite_points", file.finite_points}};
  json["options"] = jsonOf(file.options_json, "options_json");
  Json times = Json::object();
  for (const auto& [stage, ms] : file.timings_ms)
    addFinite(times, stage.c_str(), ms);
  json["timings_ms"] = times;
  if (file.table)
    json["table"] = *file.table;
  const Json extra = jsonOf(file.extra_json, "extra_json");
  if (!extra.is_object())
    throw Exception("extra_json is no JSON object");
  for (const auto& [key, value] : extra.items())
    json[key] = value;
  json["generator"] = "pcl_sq " PCL_SQ_VERSION;
}

/** \brief The text. A path may hold bytes that are not UTF-8; they become replacement
 * characters. */
std::string textOf(const Json& json, int indent);

/** \brief Parses a text and reads it into a file. \param[in] what the text should be,
 * "a model" \param[out] file cleared on failure \param[out] why optional */
template <class File, class Read>
bool readText(const std::string& text,
              const std::string& what,
              const Read& read,
              File& file,
              std::string* why) {
  file = {};
  std::string reason;
  Json json;
  if (parseJson(text, json, &reason)) {
    try {
      read(json, file);
      return true;
    } catch (const Refusal& refusal) {
      reason = refusal.why;
    } catch (const Json::exception&) {
      reason = "not valid JSON of " + what + ": a member is of another type";
    }
  }
  file = {};
  if (why)
    *why = reason;
  return false;
}

/** \brief Reads a file by name. \param[in] kind what it should be, "model"
 * \param[out] file cleared on failure \param[out] why optional */
template <class File>
bool loadFile(const std::string& path,
              const std::string& kind,
              File& file,
              std::string* why) {
  file = {};
  std::string text, reason;
  if (!readFile(path, text, why))
    return false;
  if (fromJson(text, file, &reason))
    return true;
  if (why)
    *why = "'" + path + "' is no " + kind + " file: " + reason;
  return false;
}

/** \brief Writes a file by name if loadFile() would read it again. \param[in] kind what
 * it is, "model" \param[out] why optional */
template <class File>
bool saveFile(const std::string& path,
              const std::string& kind,
              const File& file,
              std::string* why) {
  std::string text, reason;
  File again;
  try {
    text = toJson(file);
    if (fromJson(text, again, &reason))
      return writeFile(path, text + "\n", why);
  } catch (const Exception& exception) {
    reason = exception.what();
  }
  if (why)
    *why = "'" + path + "' is not written, for it would be no " + kind +
           " file: " + reason;
  return false;
}

} // namespace pcl_sq::detail
