// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <sys/types.h>

namespace pcl_sq {

/** \brief An X server without a screen, for this process alone.
 *
 * The server picks a free display number itself, so any number of them can start at
 * once. It ends with this object, and also if the process dies: it is told to end when
 * its last client has gone. */
class PrivateXvfb {
public:
  /** \throws pcl_sq::Exception if Xvfb is not installed or does not come up */
  PrivateXvfb();
  ~PrivateXvfb();
  PrivateXvfb(const PrivateXvfb&) = delete;
  PrivateXvfb& operator=(const PrivateXvfb&) = delete;

  /** \brief Name for XOpenDisplay, e.g. ":7". */
  const std::string& name() const { return name_; }

private:
  void stop();

  pid_t pid_ = -1;
  std::string name_;
};

} // namespace pcl_sq
