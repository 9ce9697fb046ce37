// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/roi.h"
#include "scene/mesh_bvh.h"
#include "scene/scene_camera.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief An object on a textured table before a wall, in the rig's frame. */
struct Scene {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< object to rig
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< object to rig [m]
  Eigen::Vector3d color = {0.6, 0.6, 0.6};                ///< of the object
  Eigen::Vector3d table_normal = {0, -1, 0};              ///< upwards, unit
  double table_offset = 0.0;                              ///< n.p + d = 0 on the table
  double wall_distance = 0.9; ///< from the object along the table [m]
  double contrast = 1.0;      ///< of all textures, [0, 2]
  double noise_sigma = 2.0;   ///< of the sensor [grey levels]
  int supersampling = 2;      ///< rays per pixel and direction
  std::uint64_t seed = 1;
};

/** \brief Places an object on the table. \param[in] box its bounding box in its frame
 * \param[in] center of the box in the rig's frame [m] \param[in] yaw about the vertical
 * \param[in] pitch of the camera, downwards [rad] */
Scene placeOnTable(const Eigen::AlignedBox3d& box,
                   const Eigen::Vector3d& center,
                   double yaw,
                   double pitch);

/** \brief 8-bit colour image, BGR, rows from the top. */
struct RenderedImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bgr;
};
/** \brief What a camera's pixel centres see. */
struct RenderedTruth {
  int width = 0, height = 0;
  std::vector<float> depth;       ///< z in the camera's frame [m], infinity = nothing
  std::vector<std::uint8_t> mask; ///< 255 = object
  CellRect roi;                   ///< box of the mask
  std::size_t visible_pixels = 0; ///< of the mask
};

/** \brief Ray casting; the same bytes for any number of threads.
 * \param[in] view number that keeps the noise of several images apart
 * \param[in] threads 0 = all cores */
RenderedImage render(const Scene& scene,
                     const MeshBvh& object,
                     const SceneCamera& camera,
                     std::uint64_t view,
                     unsigned int threads = 0);
RenderedTruth renderTruth(const Scene& scene,
                          const MeshBvh& object,
                          const SceneCamera& camera,
                          unsigned int threads = 0);

} // namespace pcl_sq::app
