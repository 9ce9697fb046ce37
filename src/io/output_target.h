// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include <sys/stat.h>

namespace pcl_sq::detail {

/** \brief What stands behind the name of an output. */
struct OutputTarget {
  enum Kind {
    REGULAR,   ///< a file that is or may be made: written beside it and renamed
    STREAM,    ///< a pipe or device: opened and written into
    DESCRIPTOR ///< one of the program's own open files, such as standard output
  };
  Kind kind = REGULAR;
  std::filesystem::path path; ///< its real name, links followed
  bool exists = false;
  struct stat status = {}; ///< where it exists
  int descriptor = -1;
};

/** \brief A refusal or a failure; does not leave core. */
struct FileFailure {
  std::string why;
};

/** \brief Refuses a name that the system would take for the shorter one before its zero
 * byte. \throw FileFailure */
void refuseZeroBytes(const std::string& path);

/** \brief Follows the links of a name. \throw FileFailure for what is no place for a
 * file at all: folders, sockets, folders that do not exist */
OutputTarget resolveOutput(const std::string& path);

/** \brief \throw FileFailure if the rights do not allow to write there */
void checkRights(const std::string& path, const OutputTarget& target);

/** \brief Opens a stream. \return its descriptor, to be closed by closeStream() */
int openStream(const std::string& path, const OutputTarget& target);
void closeStream(const OutputTarget& target, int descriptor);

/** \brief Writes everything, whatever pieces the system takes. A regular file is cut
 * back to what it was if that fails. \throw FileFailure */
void writeAll(const std::string& path, int descriptor, const std::string& bytes);

/** \brief \throw FileFailure in words for the errno of a failed write */
[[noreturn]] void failToWrite(const std::string& path, int error);

/** \brief The descriptor of standard output, which reserveStandardOutput() moves. */
int standardOutput();

} // namespace pcl_sq::detail
