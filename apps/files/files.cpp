// SPDX-License-Identifier: BSD-3-Clause
#include "files/files.h"

#include "command_line/app.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace fs = std::filesystem;

namespace pcl_sq::app {

namespace {

std::vector<std::string> inputs, written;
std::vector<std::pair<std::string, std::string>> claimed; ///< option, path

void checkFormat(const std::string& option,
                 const std::string& path,
                 const std::vector<std::string>& formats) {
  const std::string format = formatOf(path, formats.front());
  if (std::find(formats.begin(), formats.end(), format) != formats.end())
    return;
  std::string list;
  for (std::size_t i = 0; i < formats.size(); ++i)
    list += (i == 0 ? "" : i + 1 < formats.size() ? ", " : " or ") + formats[i];
  throw UsageError(option + ": '" + path + "' must end in " + list + ".");
}

} // namespace

std::string readFile(const std::string& path) {
  std::string bytes, why;
  if (!pcl_sq::readFile(path, bytes, &why))
    throw Failure(why + ".");
  return bytes;
}

void writeOutput(const std::string& path, const std::string& bytes) {
  std::string why;
  if (!writeFile(path, bytes, &why))
    throw Failure(why + ".");
  noteWritten(path);
}

void noteWritten(const std::string& path) {
  if (!isStandardOutput(path))
    written.push_back(path);
}

std::string writtenFiles() {
  std::string line;
  for (const std::string& path : written)
    line += (line.empty() ? "wrote " : ", ") + path;
  return line;
}

void claimOutput(const std::string& option,
                 const std::string& path,
                 const std::vector<std::string>& formats) {
  if (path.empty())
    return;
  if (!formats.empty())
    checkFormat(option, path, formats);
  std::string why;
  if (!isWritable(path, &why))
    throw Failure(why + ".");
  for (const auto& [other, claimed_path] : claimed)
    if (isSameFile(path, claimed_path))
      throw UsageError(other + " and " + option + " both name '" + path +
                       "'; give each a file of its own.");
  for (const std::string& input : inputs)
    if (input != "-" && isSameFile(path, input))
      throw UsageError(option + " would replace the input '" + input +
                       "'; name another file.");
  claimed.emplace_back(option, path);
  if (isStandardOutput(path))
    reserveStandardOutput();
}

void claimFolder(const std::string& path) {
  std::error_code error;
  fs::path folder = fs::absolute(path, error);
  while (!fs::exists(folder, error) && folder.has_relative_path())
    folder = folder.parent_path();
  std::string why;
  if (!isWritable((folder / ".pcl_sq").string(), &why))
    throw Failure(
        "cannot write into '" + path + "': '" + folder.string() +
        (fs::is_directory(folder, error) ? "' is not writable." : "' is no folder."));
}

void makeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw Failure("cannot make the folder '" + path + "': " + error.message() + ".");
}

void claimInput(const std::string& path) {
  if (path.empty())
    return;
  const bool standard = path == "-" || path == "/dev/stdin";
  if (standard && std::find(inputs.begin(), inputs.end(), "-") != inputs.end())
    throw UsageError("two inputs are standard input, which can be only one of them; "
                     "name a file for the other.");
  inputs.push_back(standard ? "-" : path);
}

} // namespace pcl_sq::app
