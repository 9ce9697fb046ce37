// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "visualization/drawing/scene.h"

#include <vtkSmartPointer.h>

class vtkRenderer;

namespace pcl_sq {

/** \brief Puts a scene's three-dimensional things into a renderer.
 *
 * The graphics hardware computes in single precision: everything is moved and scaled so
 * that the object lies around the origin with size one, wherever the cloud lies. */
class Stage {
public:
  /** \param[in] focus what the picture frames \param[in] zoom pixels of the rendering
   * per pixel of the picture */
  Stage(vtkRenderer* renderer,
        const ViewCamera& camera,
        const Eigen::Matrix3Xd& focus,
        double zoom);

  void add(const SnapshotScene& scene);

private:
  Eigen::Vector3d toStage(const Eigen::Vector3d& point) const {
    return (point - origin_) / scale_;
  }
  Eigen::Matrix3Xd lifted(const std::vector<Eigen::Vector3d>& points) const;
  void placeCamera();
  void placeLights();
  void addClouds(const SnapshotScene& scene);
  void addPart(const SnapshotScene& scene, std::size_t index);
  void addSurface(const SnapshotScene::Surface& surface);
  void addSegments(const Eigen::Matrix3Xd& ends, Color color, double width);
  void addMarkers(const SnapshotScene::Markers& markers);

  vtkRenderer* renderer_;
  const ViewCamera& camera_;
  double zoom_;
  Eigen::AlignedBox3d box_; ///< of the focus
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double scale_ = 1.0; ///< [m]
};

} // namespace pcl_sq
