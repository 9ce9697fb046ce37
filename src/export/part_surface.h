// SPDX-License-Identifier: BSD-3-Clause
// Private. Surfaces as pages and scenes show them.
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/palette.h"
#include "pcl_sq/scene_io.h"

#include <string>

namespace pcl_sq::detail {

/** \brief A part's surface with a normal at each vertex. */
struct ShownSurface {
  TriangleMesh mesh;
  std::vector<Eigen::Vector3d> normals; ///< outward, unit length
};

/** \brief Fine enough for a picture: some 3,500 vertices. */
ShownSurface shownSurface(const Superquadric& part);

/** \brief What a part is called and how it looks. */
struct PartLabel {
  std::string name;
  Color color;
};

/** \brief "part 1" ..., each part in its own colour. */
std::vector<PartLabel> labelsOf(const MultiSuperquadric& model);
/** \brief "thing 1", or "thing 1, part 1" ... of several, in the order of
 * SceneFile::all(); the parts of a thing share its colour. */
std::vector<PartLabel> labelsOf(const SceneFile& scene);

/** \brief The scene's things as one model on its table. */
ModelFile asOneModel(const SceneFile& scene);

/** \brief The rotation that takes up to +y, as glTF and WebGL's pages have it. */
Eigen::Quaterniond toYUp(const Eigen::Vector3d& up);

} // namespace pcl_sq::detail
