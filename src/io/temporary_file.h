// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/output_target.h"

namespace pcl_sq::detail {

/** \brief A hidden file beside a regular target, removed unless it gets its name. */
class TemporaryFile {
public:
  /** \brief Makes it with the permissions that the target has, or a new file gets.
   * \throw FileFailure */
  TemporaryFile(const std::string& path, const OutputTarget& target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }
  /** \brief Hands all to the system. \throw FileFailure if it finds fault only now */
  void finish();
  /** \brief Gives the file its name; it stays open. \throw FileFailure */
  void takeName();

private:
  bool open(const std::string& name);
  std::string path_, name_;
  std::filesystem::path target_;
  int descriptor_ = -1;
};

} // namespace pcl_sq::detail
