// SPDX-License-Identifier: BSD-3-Clause
#include "files.h"

#include "app.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl_sq::app {

std::string readFile(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw Failure("'" + path + "' is a folder; give a file.");
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Failure("cannot read '" + path +
                  "': " + std::generic_category().message(errno) + ".");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void writeAtomically(const std::string& path,
                     const std::function<void(const std::string&)>& write) {
  const fs::path target(path);
  const fs::path temporary =
      target.parent_path() / ("." + target.stem().string() + "." +
                              std::to_string(getpid()) + target.extension().string());
  try {
    write(temporary.string());
    fs::rename(temporary, target);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void writeTextFile(const std::string& path, const std::string& text) {
  writeAtomically(path, [&](const std::string& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.flush();
    if (!stream)
      throw Failure("cannot write '" + path +
                    "': " + std::generic_category().message(errno) + ".");
  });
}

void checkWritable(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw Failure("cannot write '" + path + "': it is a folder; give a file name.");
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty())
    folder = ".";
  if (!fs::is_directory(folder, error))
    throw Failure("cannot write '" + path + "': the folder does not exist; create it.");
  if (access(folder.c_str(), W_OK) != 0)
    throw Failure("cannot write '" + path + "': the folder is not writable.");
}

std::string extensionOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return char(std::tolower(static_cast<unsigned char>(c)));
  });
  return extension;
}

} // namespace pcl_sq::app
