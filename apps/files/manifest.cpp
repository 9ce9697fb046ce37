// SPDX-License-Identifier: BSD-3-Clause
#include "files/manifest.h"

#include "command_line/app.h"
#include "files/files.h"
#include "report/text.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <sstream>

namespace pcl_sq::app {

std::vector<std::string> readManifest(const std::string& path) {
  std::istringstream text(readFile(path));
  std::vector<std::string> names;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (!line.empty() && line.front() != '#')
      names.push_back(line);
  }
  if (names.empty())
    throw Failure("'" + printable(path) +
                  "' names no cloud; write one file name a line into it.");
  return names;
}

std::vector<std::string> shardOf(const std::vector<std::string>& names,
                                 const std::string& shard) {
  std::size_t mine = 0, count = 0;
  char rest = 0;
  if (std::sscanf(shard.c_str(), "%zu/%zu%c", &mine, &count, &rest) != 2 ||
      shard.find('-') != std::string::npos || mine < 1 || mine > count)
    throw UsageError("--shard wants I/N with I from 1 to N, such as 3/10.");
  std::vector<std::string> some;
  for (std::size_t i = mine - 1; i < names.size(); i += count)
    some.push_back(names[i]);
  return some;
}

DoneLines readDoneLines(const std::string& path) {
  DoneLines lines;
  if (!std::filesystem::exists(path))
    return lines;
  std::string text = readFile(path);
  text.resize(text.find_last_of('\n') == std::string::npos ? 0
                                                           : text.find_last_of('\n'));
  std::istringstream stream(text);
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    const auto input =
        json.is_object() ? json.value("input", nlohmann::json()) : nlohmann::json();
    if (!input.is_object() || !input.contains("path") || !input["path"].is_string())
      throw Failure("line " + std::to_string(number) + " of '" + printable(path) +
                    "' is none of --jsonl, so --resume does not go on with it; give "
                    "another -o.");
    ++lines.done[input["path"].get<std::string>()];
    lines.all_fitted = lines.all_fitted && !json.contains("error");
  }
  lines.text = text;
  return lines;
}

std::vector<std::string> withoutDone(const std::vector<std::string>& names,
                                     DoneLines& lines) {
  std::vector<std::string> left;
  for (const std::string& name : names) {
    // as it stands in a line: what is not UTF-8 is replaced there
    const std::string in_line =
        nlohmann::json::parse(
            nlohmann::json(name).dump(
                -1, ' ', false, nlohmann::json::error_handler_t::replace))
            .get<std::string>();
    const auto done = lines.done.find(in_line);
    if (done != lines.done.end() && done->second > 0)
      --done->second;
    else
      left.push_back(name);
  }
  return left;
}

} // namespace pcl_sq::app
