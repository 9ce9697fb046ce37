// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/drawing/scene.h"

#include <memory>
#include <string>

namespace pcl_sq {

/** \brief A window that is never shown; several pictures can be taken in it. */
class FrameRenderer {
public:
  FrameRenderer() = default;
  virtual ~FrameRenderer() = default;
  FrameRenderer(const FrameRenderer&) = delete;
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  /** \throws pcl_sq::Exception if nothing was rendered */
  virtual SnapshotImage render(const SnapshotScene& scene,
                               const Eigen::Matrix3Xd& focus,
                               const ViewCamera& camera) = 0;
};

/** \brief What VTK does for this component. Where libraries are shared this is a
 * plug-in, so that only runs which make pictures load VTK. */
struct VtkPart {
  /** \throws pcl_sq::Exception if no display can be had */
  std::unique_ptr<FrameRenderer> (*makeRenderer)(int width, int height);
  /** \brief A PNG file; empty where it cannot be made. */
  std::string (*pngBytes)(const SnapshotImage& image);
  /** \brief A ParaView file; empty where it cannot be made.
   * \param[in] colors one per part, or none: no colours */
  std::string (*vtpBytes)(const std::vector<TriangleMesh>& parts,
                          const std::vector<Color>& colors);
};

/** \brief Loads it at the first call. \throws pcl_sq::Exception if it cannot be loaded
 * \param[in] who function that needs it, for the message */
const VtkPart& vtkPart(const std::string& who);

} // namespace pcl_sq

/** \brief The one function of the plug-in. */
extern "C" PCL_SQ_EXPORTS const pcl_sq::VtkPart* pcl_sq_vtk_part();
