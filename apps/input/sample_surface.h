// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/shape.h"

namespace pcl_sq::app {

/** \brief Points uniform in area on the triangles, the same on every machine.
 * \return empty if the triangles have no area */
std::vector<Eigen::Vector3d> sampleSurface(const Shape& shape, std::size_t count);

} // namespace pcl_sq::app
