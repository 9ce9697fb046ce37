// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq::detail {

/** \brief Closed surface min_k G_k = 1 by marching tetrahedra, vertices exact on it. */
TriangleMesh meshUnion(const MultiSuperquadric& model, int resolution);

} // namespace pcl_sq::detail
