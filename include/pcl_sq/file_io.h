// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <memory>
#include <string>

namespace pcl_sq {

/** \brief The whole file as bytes.
 * \param[in] path "-" or /dev/stdin is standard input, which is read once and
 * remembered; a pointer of Git LFS or a web page in the place of a file is refused
 * \param[out] bytes cleared on failure
 * \param[out] why the reason of a failure, a sentence without its full stop (optional)
 * \return whether the file could be read to its end */
[[nodiscard]] PCL_SQ_EXPORTS bool
readFile(const std::string& path, std::string& bytes, std::string* why = nullptr);

/** \brief Writes a whole file, or leaves everything as it was.
 *
 * A regular file appears under its name when it is complete: it is written to a hidden
 * name beside it and renamed. A file that exists keeps its permissions; a symbolic link
 * stays and its target is replaced. What else exists (a pipe, a device, /dev/stdout,
 * /dev/fd/3) is written into and never replaced; sockets and folders are refused. So
 * are files and folders that nobody has the right to write, for root too.
 * \param[in] path "-" is standard output
 * \param[out] why the reason of a failure, such as a full disk or a pipe without a
 * reader, a sentence without its full stop (optional)
 * \return whether every byte was taken */
[[nodiscard]] PCL_SQ_EXPORTS bool writeFile(const std::string& path,
                                            const std::string& bytes,
                                            std::string* why = nullptr);

/** \brief Whether writeFile() may write there: asked before long work is begun.
 * \param[out] why as of writeFile() (optional) */
[[nodiscard]] PCL_SQ_EXPORTS bool isWritable(const std::string& path,
                                             std::string* why = nullptr);

/** \brief Whether two names are those of one file, pipe or standard output, however
 * they are spelt. Two names of a device, such as /dev/null, do not count. */
[[nodiscard]] PCL_SQ_EXPORTS bool isSameFile(const std::string& a,
                                             const std::string& b);

/** \brief Whether writeFile() writes to the program's standard output. */
[[nodiscard]] PCL_SQ_EXPORTS bool isStandardOutput(const std::string& path);

/** \brief The path's ending in lower case with its dot: ".pcd"; "" if there is none. */
PCL_SQ_EXPORTS std::string extensionOf(const std::string& path);

/** \brief The ending that tells the format of a file that is to be written.
 * \param[in] stream_format that of standard output, pipes and devices without ending */
PCL_SQ_EXPORTS std::string formatOf(const std::string& path,
                                    const std::string& stream_format);

/** \brief Keeps standard output for files that are written to "-" or /dev/stdout: what
 * is printed from now on goes to standard error. For programs, before they print. */
PCL_SQ_EXPORTS void reserveStandardOutput();

/** \brief Removes the hidden files of writes that are under way, for a program that
 * ends early. Takes a lock: not for signal handlers, but for a thread in sigwait(). */
PCL_SQ_EXPORTS void removeTemporaries();

/** \brief A file that grows line by line.
 *
 * It replaces what was under its name when its first line is complete. A line is there
 * whole or not at all. Paths are those of writeFile(). */
class PCL_SQ_EXPORTS LineFile {
public:
  explicit LineFile(const std::string& path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /** \brief Adds a line and its end, at once: nothing is kept back in memory.
   * \param[out] why as of writeFile() (optional) \return whether it was written */
  [[nodiscard]] bool append(const std::string& line, std::string* why = nullptr);

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pcl_sq
