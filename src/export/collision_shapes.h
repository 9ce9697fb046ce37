// SPDX-License-Identifier: BSD-3-Clause
// Private. What a part is for software that knows boxes, cylinders, spheres and convex
// meshes.
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief A shape in the cloud's frame. */
struct CollisionShape {
  enum Kind { BOX, CYLINDER, SPHERE, MESH } kind = MESH;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< [m]
  /** \brief Columns are its axes; a cylinder's is the third. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero(); ///< [m]
  TriangleMesh mesh; ///< of MESH, about the centre, in the cloud's axes
};

/** \brief Shapes whose union is nearly a part.
 * \param[in] tolerance see RobotExportOptions::primitive_tolerance */
std::vector<CollisionShape> collisionShapes(const Superquadric& part, double tolerance);

/** \brief The hull of points as triangles, counter-clockwise seen from outside; empty
 * if they lie in a plane. */
TriangleMesh hullMesh(const std::vector<Eigen::Vector3d>& points);

} // namespace pcl_sq::detail
