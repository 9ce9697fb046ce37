// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/file_io.h"

#include "io/output_target.h"
#include "io/temporary_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pcl_sq {

namespace detail {

/** \brief A pipe or device that is open. */
struct OpenStream {
  OpenStream(const std::string& path, const OutputTarget& where)
      : target(where), descriptor(detail::openStream(path, where)) {}
  ~OpenStream() { detail::closeStream(target, descriptor); }
  OpenStream(const OpenStream&) = delete;
  OpenStream& operator=(const OpenStream&) = delete;
  const OutputTarget target;
  const int descriptor;
};

} // namespace detail

using detail::FileFailure;
using detail::OutputTarget;
using detail::TemporaryFile;

namespace {

/** \brief Runs \a action. \return whether it did not fail */
template <typename Action>
bool succeeds(const Action& action, std::string* why) {
  try {
    action();
    return true;
  } catch (const FileFailure& failure) {
    if (why)
      *why = failure.why;
    return false;
  }
}

/** \brief What an error of opening or reading means to who named the file. */
std::string readingFailed(int error) {
  switch (error) {
  case ENOENT:
    return "the file does not exist";
  case EACCES:
  case EPERM:
    return "you have no right to read it; change its permissions or copy it";
  case ENOTDIR:
    return "a part of its path is a file, no folder; correct the path";
  case ELOOP:
    return "its links lead in a circle; name the file itself";
  case ENAMETOOLONG:
    return "the name is too long";
  case EIO:
    return "the disk or the connection fails; copy the file from elsewhere";
  default:
    return std::generic_category().message(error);
  }
}

std::string bytesOf(const std::string& path, int descriptor) {
  std::string bytes;
  char piece[1 << 16];
  for (;;) {
    const ssize_t taken = read(descriptor, piece, sizeof piece);
    if (taken == 0)
      return bytes;
    if (taken > 0)
      bytes.append(piece, static_cast<std::size_t>(taken));
    else if (errno == EISDIR)
      throw FileFailure{"'" + path + "' is a folder; give a file"};
    else if (errno != EINTR)
      throw FileFailure{"cannot read '" + path + "': " + readingFailed(errno)};
  }
}

/** \brief Refuses devices such as /dev/zero, which would be read until memory ends. */
void refuseEndless(const std::string& path, int descriptor) {
  struct stat file = {}, nothing = {};
  if (fstat(descriptor, &file) == 0 && S_ISCHR(file.st_mode) &&
      isatty(descriptor) == 0 &&
      !(stat("/dev/null", &nothing) == 0 && nothing.st_rdev == file.st_rdev))
    throw FileFailure{"'" + path + "' is a device, not a file; give a file"};
}

std::string readNamed(const std::string& path) {
  detail::refuseZeroBytes(path);
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0)
    throw FileFailure{"cannot read '" + path + "': " + readingFailed(errno)};
  try {
    refuseEndless(path, descriptor);
    std::string bytes = bytesOf(path, descriptor);
    close(descriptor);
    return bytes;
  } catch (...) {
    close(descriptor);
    throw;
  }
}

/** \brief What often lies where a file should be: nobody means it, whatever is read. */
void refuseStandIns(const std::string& path, const std::string& bytes) {
  std::string start = bytes.substr(0, 200);
  std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  start.erase(0, start.find_first_not_of(" \t\r\n"));
  const auto begins = [&start](const char* with) { return start.rfind(with, 0) == 0; };
  if (begins("version https://git-lfs."))
    throw FileFailure{"'" + path +
                      "' is a pointer of Git LFS in the place of the file; fetch the "
                      "file by 'git lfs pull'"};
  if (begins("<!doctype html") || begins("<html"))
    throw FileFailure{"'" + path +
                      "' is a page of the web, perhaps what a server said instead of "
                      "the file; download it again"};
}

} // namespace

bool readFile(const std::string& path, std::string& bytes, std::string* why) {
  bytes.clear();
  return succeeds(
      [&] {
        std::string all;
        if (path != "-" && path != "/dev/stdin")
          all = readNamed(path);
        else {
          static const std::string standard_input =
              bytesOf("standard input", STDIN_FILENO);
          all = standard_input;
        }
        refuseStandIns(path, all);
        bytes = std::move(all);
      },
      why);
}

bool writeFile(const std::string& path, const std::string& bytes, std::string* why) {
  return succeeds(
      [&] {
        const OutputTarget target = detail::resolveOutput(path);
        detail::checkRights(path, target);
        if (target.kind == OutputTarget::REGULAR) {
          TemporaryFile file(path, target);
          detail::writeAll(path, file.descriptor(), bytes);
          file.finish();
          file.takeName();
          return;
        }
        const detail::OpenStream stream(path, target);
        detail::writeAll(path, stream.descriptor, bytes);
      },
      why);
}

bool isWritable(const std::string& path, std::string* why) {
  return succeeds([&] { detail::checkRights(path, detail::resolveOutput(path)); }, why);
}

bool isSameFile(const std::string& a, const std::string& b) {
  OutputTarget first, second;
  const auto resolve = [&] {
    first = detail::resolveOutput(a);
    second = detail::resolveOutput(b);
  };
  if (!succeeds(resolve, nullptr))
    return false;
  if (first.descriptor >= 0 && first.descriptor == second.descriptor)
    return true;
  if (first.exists && second.exists)
    return !S_ISCHR(first.status.st_mode) &&
           first.status.st_dev == second.status.st_dev &&
           first.status.st_ino == second.status.st_ino;
  return !first.exists && !second.exists && first.path == second.path;
}

bool isStandardOutput(const std::string& path) {
  OutputTarget target;
  return succeeds([&] { target = detail::resolveOutput(path); }, nullptr) &&
         target.descriptor == detail::standardOutput();
}

std::string extensionOf(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return extension;
}

std::string formatOf(const std::string& path, const std::string& stream_format) {
  const std::string extension = extensionOf(path);
  OutputTarget target;
  const bool known = succeeds([&] { target = detail::resolveOutput(path); }, nullptr);
  return extension.empty() && known && target.kind != OutputTarget::REGULAR
             ? stream_format
             : extension;
}

struct LineFile::State {
  std::string path;
  // one of the two, once the first line is there
  std::unique_ptr<TemporaryFile> file;
  std::unique_ptr<detail::OpenStream> stream;

  void open(const std::string& first) {
    const OutputTarget target = detail::resolveOutput(path);
    detail::checkRights(path, target);
    if (target.kind != OutputTarget::REGULAR) {
      stream = std::make_unique<detail::OpenStream>(path, target);
      detail::writeAll(path, stream->descriptor, first);
      return;
    }
    auto made = std::make_unique<TemporaryFile>(path, target);
    detail::writeAll(path, made->descriptor(), first);
    made->takeName();
    file = std::move(made);
  }
};

LineFile::LineFile(const std::string& path) : state_(std::make_unique<State>()) {
  state_->path = path;
}

LineFile::~LineFile() = default;

bool LineFile::append(const std::string& line, std::string* why) {
  return succeeds(
      [&] {
        const State& s = *state_;
        if (s.file)
          detail::writeAll(s.path, s.file->descriptor(), line + "\n");
        else if (s.stream)
          detail::writeAll(s.path, s.stream->descriptor, line + "\n");
        else
          state_->open(line + "\n");
      },
      why);
}

} // namespace pcl_sq
