// SPDX-License-Identifier: BSD-3-Clause
// Private. The mesh of a body with a rim.
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq::detail {

/** \brief meshSuperquadric() of a body with a rim: closed, of a hollow one outside,
 * rim, inside and floor. */
TriangleMesh meshOpenBody(const Superquadric& s, int divisions);

/** \brief Whether a union has parts with a rim. */
bool hasOpenParts(const MultiSuperquadric& model);

/** \brief The parts without a rim. */
MultiSuperquadric withoutOpenParts(const MultiSuperquadric& model);

/** \brief The mesh of a union from that of its parts without a rim: beside it a closed
 * mesh of each part with one. Where a handle's ends lie in a wall the two overlap. */
TriangleMesh
addOpenParts(const MultiSuperquadric& model, int divisions, TriangleMesh others);

} // namespace pcl_sq::detail
