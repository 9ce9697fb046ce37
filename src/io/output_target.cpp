// SPDX-License-Identifier: BSD-3-Clause
#include "io/output_target.h"

#include "pcl_sq/file_io.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl_sq {
namespace detail {
namespace {

constexpr mode_t ANYBODY_WRITES = S_IWUSR | S_IWGRP | S_IWOTH;

std::atomic<int> standard_output{STDOUT_FILENO};

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  const std::string place = path == "-" ? "to standard output" : "'" + path + "'";
  throw FileFailure{"cannot write " + place + ": " + why};
}

/** \brief The number if this is one of the program's own open files, as /dev/stdout
 * and /dev/fd/3 are; otherwise -1. */
int ownDescriptor(const fs::path& folder, const std::string& name) {
  const std::string process = "/proc/" + std::to_string(getpid()) + "/";
  const std::string place = folder.string();
  if (place.compare(0, process.size(), process) != 0 || folder.filename() != "fd" ||
      name.empty() || name.size() > 6 ||
      !std::all_of(
          name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return -1;
  const int number = std::stoi(name);
  return number == STDOUT_FILENO ? standardOutput() : number;
}

OutputTarget ownFile(const std::string& path, int descriptor) {
  OutputTarget target;
  target.kind = OutputTarget::DESCRIPTOR;
  target.descriptor = descriptor;
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
    refuse(path, "it is not open for writing");
  target.exists = fstat(descriptor, &target.status) == 0;
  return target;
}

/** \brief The folder of a name, all its links followed. */
fs::path realFolder(const std::string& path, const fs::path& name) {
  const fs::path parent = name.parent_path().empty() ? "." : name.parent_path();
  std::error_code error;
  const fs::path folder = fs::canonical(parent, error);
  if (error == std::errc::no_such_file_or_directory)
    refuse(path, "the folder '" + parent.string() + "' does not exist; create it");
  if (error)
    failToWrite(path, error.value());
  if (!fs::is_directory(folder, error))
    refuse(path, "'" + parent.string() + "' is no folder");
  return folder;
}

bool refusesWriting(const fs::path& path, mode_t mode, int rights) {
  // root may write everything, but what nobody may write is meant to be kept
  return (mode & ANYBODY_WRITES) == 0 || access(path.c_str(), rights) != 0;
}

} // namespace

int standardOutput() {
  return standard_output;
}

void failToWrite(const std::string& path, int error) {
  switch (error) {
  case ENOSPC:
  case EDQUOT:
    refuse(path, "the disk is full; free some space or name another place");
  case EFBIG:
    refuse(path, "it is larger than a file may be here (ulimit -f)");
  case EPIPE:
    refuse(path, "the program that should read it has gone");
  case EROFS:
    refuse(path, "the disk is read-only; name another place");
  case EACCES:
  case EPERM:
    refuse(path, "you have no right to write there; name another place");
  case ENAMETOOLONG:
    refuse(path, "the name is too long");
  case ENOTDIR:
    refuse(path, "a part of its path is a file, no folder; correct the path");
  case ELOOP:
    refuse(path, "its links lead in a circle; name another place");
  default:
    refuse(path, std::generic_category().message(error));
  }
}

void refuseZeroBytes(const std::string& path) {
  if (path.find('\0') != std::string::npos)
    throw FileFailure{"a file name holds a zero byte, which no name may"};
}

OutputTarget resolveOutput(const std::string& path) {
  if (path.empty())
    refuse(path, "the name is empty");
  refuseZeroBytes(path);
  if (path == "-")
    return ownFile(path, standardOutput());
  constexpr int MOST_LINKS = 40; // as many as Linux follows
  fs::path name = path;
  for (int i = 0; i < MOST_LINKS; ++i) {
    const fs::path folder = realFolder(path, name);
    const std::string last = name.filename().string();
    if (last.empty() || last == "." || last == "..")
      refuse(path, "it is a folder; give a file name");
    if (const int number = ownDescriptor(folder, last); number >= 0)
      return ownFile(path, number);
    OutputTarget target;
    target.path = folder / last;
    if (lstat(target.path.c_str(), &target.status) != 0) {
      if (errno != ENOENT)
        failToWrite(path, errno);
      return target;
    }
    target.exists = true;
    if (S_ISLNK(target.status.st_mode)) {
      std::error_code error;
      name = folder / fs::read_symlink(target.path, error);
      if (error)
        failToWrite(path, error.value());
      continue;
    }
    if (S_ISDIR(target.status.st_mode))
      refuse(path, "it is a folder; give a file name");
    if (S_ISSOCK(target.status.st_mode))
      refuse(path, "it is a socket");
    target.kind =
        S_ISREG(target.status.st_mode) ? OutputTarget::REGULAR : OutputTarget::STREAM;
    return target;
  }
  refuse(path, "its links go in a circle");
}

void checkRights(const std::string& path, const OutputTarget& target) {
  if (target.kind == OutputTarget::DESCRIPTOR)
    return;
  if (target.exists && refusesWriting(target.path, target.status.st_mode, W_OK))
    refuse(path, "it is read-only; make it writable or name another file");
  if (target.kind == OutputTarget::STREAM)
    return;
  const fs::path folder = target.path.parent_path();
  struct stat status = {};
  if (stat(folder.c_str(), &status) != 0)
    failToWrite(path, errno);
  if (refusesWriting(folder, status.st_mode, W_OK | X_OK))
    refuse(path, "the folder '" + folder.string() + "' is not writable");
}

int openStream(const std::string& path, const OutputTarget& target) {
  if (target.kind == OutputTarget::DESCRIPTOR) {
    if (target.descriptor == STDOUT_FILENO)
      std::fflush(stdout); // what was printed before comes first
    return target.descriptor;
  }
  const int descriptor = open(target.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0)
    failToWrite(path, errno);
  return descriptor;
}

void closeStream(const OutputTarget& target, int descriptor) {
  if (target.kind != OutputTarget::DESCRIPTOR && descriptor >= 0)
    close(descriptor);
}

void writeAll(const std::string& path, int descriptor, const std::string& bytes) {
  struct stat before = {};
  const bool regular = fstat(descriptor, &before) == 0 && S_ISREG(before.st_mode);
  const off_t place = regular ? lseek(descriptor, 0, SEEK_CUR) : 0;
  const auto fail = [&](int error) {
    if (regular && ftruncate(descriptor, before.st_size) == 0)
      lseek(descriptor, place, SEEK_SET);
    failToWrite(path, error);
  };
  const char* at = bytes.data();
  std::size_t left = bytes.size();
  while (left > 0) {
    const ssize_t taken = write(descriptor, at, left);
    if (taken > 0) {
      at += taken;
      left -= static_cast<std::size_t>(taken);
    } else if (taken < 0 && errno == EAGAIN) {
      pollfd ready{descriptor, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (taken == 0 || errno != EINTR)
      fail(taken == 0 ? ENOSPC : errno);
  }
}

} // namespace detail

void reserveStandardOutput() {
  if (detail::standard_output != STDOUT_FILENO)
    return;
  std::fflush(stdout);
  constexpr int ABOVE_THE_THREE = 3;
  const int kept = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, ABOVE_THE_THREE);
  if (kept < 0)
    return; // it is closed: writing to it will tell
  dup2(STDERR_FILENO, STDOUT_FILENO);
  detail::standard_output = kept;
}

} // namespace pcl_sq
