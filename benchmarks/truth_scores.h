// SPDX-License-Identifier: BSD-3-Clause
// Measures of a union of superquadrics against the exact truth.
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <string>

namespace pcl_sq::benchmark {

/** \brief Truth of one generated object. */
struct Truth {
  std::string name;
  MultiSuperquadric model;
  bool has_camera_center = false;
  Eigen::Vector3d camera_center = Eigen::Vector3d::Zero();
  double f = 0.0, cx = 0.0, cy = 0.0; ///< 0: no image
};

/** \brief Reads truth.json of a scene or the .json beside a bare cloud.
 * \throw std::runtime_error if it cannot be read */
Truth readTruth(const std::string& path);

struct Scores {
  double iou = 0.0;     ///< volumetric, of the unions
  double surface = 0.0; ///< mean distance of the surfaces, both ways [m]
};

Scores score(const MultiSuperquadric& truth, const MultiSuperquadric& model);

} // namespace pcl_sq::benchmark
