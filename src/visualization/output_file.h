// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_sq {

/** \brief A file that appears under its name only when it is complete.
 *
 * Write to temporaryPath(), then commit(); without commit() nothing is left behind. */
class OutputFile {
public:
  /** \param[in] path where the file shall be in the end \param[in] who class and method
   * for messages \throws pcl_sq::Exception if nothing can be written there */
  OutputFile(const std::string& path, const std::string& who);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /** \brief An existing empty file beside the final one. */
  const std::string& temporaryPath() const { return temporary_; }
  /** \throws pcl_sq::Exception if the file cannot get its name */
  void commit();

private:
  std::string path_, who_, temporary_;
};

/** \brief The path's ending in lower case with its dot, "" if there is none. */
std::string lowerExtension(const std::string& path);

} // namespace pcl_sq
