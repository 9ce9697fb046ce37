// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/palette.h"
#include "pcl_sq/triangle_mesh.h"

#include <string>
#include <vector>

namespace pcl_sq {

// The triangles' vertices exist in all of these. VTK writes the three formats into
// files only and does not see that a disk is full.

/** \brief The parts as one binary PLY file, single precision.
 * \param[in] colors one per part, or none: no colours */
std::string plyBytes(const std::vector<TriangleMesh>& parts,
                     const std::vector<Color>& colors);

/** \brief The parts as one Wavefront OBJ file, full precision. */
std::string objBytes(const std::vector<TriangleMesh>& parts);

/** \brief The parts as one binary STL file. */
std::string stlBytes(const std::vector<TriangleMesh>& parts);

} // namespace pcl_sq
