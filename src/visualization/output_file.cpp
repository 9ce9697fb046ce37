// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/output_file.h"

#include "pcl_sq/exception.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace pcl_sq {

OutputFile::OutputFile(const std::string& path, const std::string& who)
    : path_(path), who_(who) {
  static std::atomic<unsigned> counter{0};
  if (std::filesystem::is_directory(std::filesystem::path(path)))
    throw Exception("[" + who + "] " + path + " is a folder; name a file in it.");
  // the ending stays: VTK's PLY writer appends its own otherwise
  const std::filesystem::path target(path);
  temporary_ = target.parent_path() /
               ("." + target.stem().string() + "." + std::to_string(getpid()) + "_" +
                std::to_string(counter++) + target.extension().string());
  const int file =
      open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0)
    throw Exception("[" + who + "] " + path + " cannot be written (" +
                    std::strerror(errno) +
                    "); name a file in an existing folder that "
                    "you may write to.");
  close(file);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty())
    unlink(temporary_.c_str());
}

void OutputFile::commit() {
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw Exception("[" + who_ + "] " + path_ + " cannot be written (" +
                    std::strerror(errno) + "); name another file.");
  temporary_.clear();
}

std::string lowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return extension;
}

} // namespace pcl_sq
