// SPDX-License-Identifier: BSD-3-Clause
// Private. Surfaces as pages and scenes show them.
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq::detail {

/** \brief A part's surface with a normal at each vertex. */
struct ShownSurface {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> normals; ///< outward, unit length
};

/** \brief Fine enough for a picture: some 3,500 vertices. */
ShownSurface shownSurface(const Superquadric& part);

/** \brief The rotation that takes up to +y, as glTF and WebGL's pages have it. */
Eigen::Quaterniond toYUp(const Eigen::Vector3d& up);

} // namespace pcl_sq::detail
