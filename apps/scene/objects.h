// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Turns that leave an object as it is. */
enum class Symmetry {
  NONE,       ///< only the whole turn
  BOX,        ///< half turns about its three axes
  REVOLUTION, ///< any turn about its z axis, half turns across
  SPHERE      ///< any
};
const char* toString(Symmetry symmetry);
bool symmetryFromString(const std::string& name, Symmetry* symmetry);

/** \brief An object in its own frame: z up, x its width, y its thickness; the origin is
 * the middle of its bounding box. */
struct SceneObject {
  TriangleMesh mesh;               ///< closed, seen from outside [m]
  MultiSuperquadric superquadrics; ///< the same surface, where it is one; else empty
  Symmetry symmetry = Symmetry::NONE;
  Eigen::Vector3d color = {0.6, 0.6, 0.6}; ///< linear red, green, blue in [0, 1]
  double distance = 1.0;                   ///< usual distance from the camera [m]
  double yaw = 0.0;                        ///< usual turn about the vertical [rad]
  Eigen::AlignedBox3d box() const;
};

/** \brief Names of the procedural objects. */
const std::vector<std::string>& objectNames();
/** \brief A procedural object; \pre the name is one of objectNames(). */
SceneObject makeObject(const std::string& name);
/** \brief A mesh as an object: turned so that \a up (x, y or z) becomes z, scaled by
 * \a unit, moved to the middle of its box. */
SceneObject makeObject(TriangleMesh mesh, char up, double unit);

} // namespace pcl_sq::app
