// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <string>

namespace pcl_sq::app {

/** \brief Reads the triangles of OBJ, STL (text or binary) or PLY (text or binary,
 * little endian); polygons are cut into triangles, equal vertices are welded.
 * \throw Failure with one sentence */
TriangleMesh readMesh(const std::string& path);

/** \brief Writes a binary PLY in double precision. */
void writePly(const std::string& path, const TriangleMesh& mesh);

} // namespace pcl_sq::app
