// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/objects.h"
#include "scene/scene_renderer.h"

namespace pcl_sq::app {

/** \brief What is known of a rendered scene (schema "pcl_sq/truth", version 1), in the
 * left rectified camera's frame. */
struct SceneTruth {
  std::string scene;      ///< name of the object
  std::uint64_t seed = 0; ///< of the textures and the noise
  int width = 0, height = 0;
  double focal_length = 0.0, cx = 0.0, cy = 0.0, baseline = 0.0; ///< [px], [m]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();        ///< object to camera
  Eigen::Vector3d translation = Eigen::Vector3d::Zero(); ///< object to camera [m]
  Eigen::Vector3d size = Eigen::Vector3d::Zero(); ///< along the object's x, y, z [m]
  Symmetry symmetry = Symmetry::NONE;
  std::string mesh;        ///< file beside the truth, in the object's frame
  MultiSuperquadric parts; ///< in the camera's frame, where the object is one; or empty
  Eigen::Vector4d table = Eigen::Vector4d::Zero(); ///< n.p + d = 0, n upwards
  CellRect roi;
  std::size_t visible_pixels = 0;
};

std::string toJson(const SceneTruth& truth);
/** \throw Failure if the file cannot be read or is not a truth file */
SceneTruth readTruth(const std::string& path);
/** \brief As readTruth(), of a file's text. \param[in] path for messages */
SceneTruth truthFromJson(const std::string& text, const std::string& path);

} // namespace pcl_sq::app
