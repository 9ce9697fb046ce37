// SPDX-License-Identifier: BSD-3-Clause
// Private. The mesh of a body with a rim.
#pragma once

#include "pcl_sq/triangle_mesh.h"

namespace pcl_sq::detail {

/** \brief meshSuperquadric() of a body with a rim: closed, of a hollow one outside,
 * rim, inside and floor. */
TriangleMesh meshOpenBody(const Superquadric& s, int divisions);

} // namespace pcl_sq::detail
