// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/display/private_xvfb.h"

#include <memory>

namespace pcl_sq {

/** \brief An X connection on which VTK can render for sure.
 *
 * VTK ends the whole process where there is no display or no OpenGL 3.2, also for
 * pictures off the screen: everything it needs is tried here first. A display of this
 * machine is used if it has it all, else a private Xvfb. Displays of other machines are
 * not asked: that could take minutes, and a private server is never slower. */
class GlDisplay {
public:
  /** \throws pcl_sq::Exception if no display can be had */
  GlDisplay();
  ~GlDisplay();
  GlDisplay(const GlDisplay&) = delete;
  GlDisplay& operator=(const GlDisplay&) = delete;

  /** \brief The connection, an Xlib Display*. */
  void* connection() const { return connection_; }

private:
  std::unique_ptr<PrivateXvfb> server_;
  void* connection_ = nullptr;
};

} // namespace pcl_sq
