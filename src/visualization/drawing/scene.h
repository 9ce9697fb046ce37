// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/visualization/snapshot_renderer.h"

#include <vector>

namespace pcl_sq {

/** \brief What a SnapshotRenderer shows, in the cloud's frame [m]. */
struct SnapshotScene {
  struct Cloud {
    Eigen::Matrix3Xd points; ///< finite
    SnapshotRenderer::Colors colors;
  };
  struct Surface {
    TriangleMesh mesh;
    Color color;
    double opacity;
  };
  struct Segments {
    Eigen::Matrix3Xd ends;
    Color color;
    double width;
  };
  struct Markers {
    Eigen::Matrix3Xd points;
    Color color;
    double size;
  };

  SnapshotOptions options;
  std::vector<Cloud> clouds;
  MultiSuperquadric model;
  std::vector<Surface> surfaces;
  std::vector<Segments> segments;
  std::vector<Markers> markers;

  /** \brief Whether the parts are named beside the picture. */
  bool showsLegend() const { return options.legend && model.size() > 1; }

  /** \brief Points whose extent the picture frames: the model and what was added beside
   * it, and the clouds' points close to them; without any, the clouds without their
   * outermost points. Empty for an empty scene. */
  Eigen::Matrix3Xd focus() const;
};

} // namespace pcl_sq
