// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <pcl/PolygonMesh.h>

namespace pcl_sq {

/** \brief A mesh as PCL has it, for pcl::io, pcl::surface and pcl::visualization.
 * \return vertices as a cloud with float x, y, z [m]; triangles counter-clockwise seen
 * from outside
 * \ingroup pcl_sq */
PCL_SQ_EXPORTS pcl::PolygonMesh toPolygonMesh(const TriangleMesh& mesh);

/** \brief The surface of a superquadric as PCL's mesh.
 * \param[in] divisions as in meshSuperquadric() */
PCL_SQ_EXPORTS pcl::PolygonMesh toPolygonMesh(const Superquadric& superquadric,
                                              int divisions = 24);

/** \brief The closed surface of a union, without inner walls, as PCL's mesh.
 * \param[in] resolution as in MultiSuperquadric::meshUnion() */
PCL_SQ_EXPORTS pcl::PolygonMesh toPolygonMesh(const MultiSuperquadric& model,
                                              int resolution = 96);

} // namespace pcl_sq
