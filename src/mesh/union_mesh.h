// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq::detail {

/** \brief A closed mesh of a union's surface that knows the part behind each triangle.
 * Where two parts meet there are edges: no triangle belongs to both. */
struct PartMesh {
  TriangleMesh mesh;
  std::vector<std::size_t> part; ///< one index per triangle
};

/** \brief The surface of a union by marching tetrahedra, vertices on it.
 * \param[in] tolerance largest distance of mesh and surface [m]
 * \param[in] longest side of the cells where the surface is flat [m] */
PartMesh marchUnion(const MultiSuperquadric& model, double tolerance, double longest);

/** \brief A closed mesh of the union's surface with few triangles.
 * \param[in] tolerance largest distance of mesh and surface [m] */
TriangleMesh remeshUnion(const MultiSuperquadric& model, double tolerance);

/** \brief A point on the surfaces of all the parts named, near to \a point.
 * \return whether one was found */
[[nodiscard]] bool ontoParts(const MultiSuperquadric& model,
                             const std::vector<std::size_t>& parts,
                             Eigen::Vector3d& point);

} // namespace pcl_sq::detail
