// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/drawing/scene.h"

#include <memory>

namespace pcl_sq {

/** \brief A window that is never shown; several pictures can be taken in it. */
class FrameRenderer {
public:
  /** \throws pcl_sq::Exception if no display can be had */
  FrameRenderer(int width, int height);
  ~FrameRenderer();

  /** \throws pcl_sq::Exception if nothing was rendered */
  SnapshotImage render(const SnapshotScene& scene,
                       const Eigen::Matrix3Xd& focus,
                       const ViewCamera& camera);

private:
  struct Window;
  std::unique_ptr<Window> window_;
};

} // namespace pcl_sq
