// SPDX-License-Identifier: BSD-3-Clause
#include "files/graspit_folder.h"

#include "command_line/app.h"
#include "files/files.h"

#include <filesystem>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace pcl_sq::app {

namespace {

const char* const HEADING = "Files of pcl_sq in this folder:";

/** \brief Whether a line of a list is a file that an export of this name can have made.
 */
bool isOwn(const std::string& line, const std::string& name) {
  const fs::path path(line);
  for (const fs::path& step : path)
    if (step == "..")
      return false;
  return path.is_relative() && path.filename().string().rfind(name, 0) == 0;
}

/** \brief The files that the last export of this name left. */
std::set<std::string>
ownFiles(const fs::path& folder, const std::string& list, const std::string& name) {
  std::set<std::string> own;
  std::error_code error;
  if (!fs::is_regular_file(folder / list, error))
    return own;
  std::istringstream lines(readFile((folder / list).string()));
  std::string line;
  if (!std::getline(lines, line) || line != HEADING)
    return own;
  own.insert(list);
  while (std::getline(lines, line))
    if (isOwn(line, name))
      own.insert(line);
  return own;
}

} // namespace

std::string graspitName(const std::string& input_path) {
  std::string name = fs::path(input_path).stem().string();
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!plain)
      c = '_';
  }
  return name.empty() || name == "-" ? "object" : name;
}

void writeGraspitFolder(const std::string& folder,
                        const std::string& name,
                        std::vector<TextFile> files) {
  const fs::path root(folder);
  const std::string list = name + "_files.txt";
  std::string listed = std::string(HEADING) + "\n";
  for (const TextFile& file : files)
    listed += file.path + "\n";
  files.insert(files.begin(), {list, listed});
  std::set<std::string> old = ownFiles(root, list, name);
  std::error_code error;
  for (const TextFile& file : files)
    if (old.count(file.path) == 0 && fs::exists(root / file.path, error))
      throw Failure("'" + (root / file.path).string() +
                    "' is there and not of an export of the name '" + name +
                    "'; give another name with --graspit-name.");
  for (const TextFile& file : files)
    makeFolder((root / file.path).parent_path().string());
  for (const TextFile& file : files) {
    writeOutput((root / file.path).string(), file.contents);
    old.erase(file.path);
  }
  for (const std::string& path : old)
    fs::remove(root / path, error);
}

} // namespace pcl_sq::app
