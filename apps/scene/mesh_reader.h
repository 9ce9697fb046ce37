// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/cloud_options.h"

#include "pcl_sq/triangle_mesh.h"

#include <string>

namespace pcl_sq::app {

struct Shape;

/** \brief Reads the triangles of OBJ, STL or PLY, in metres; polygons are cut into
 * triangles, equal vertices are one.
 * \throw Failure with one sentence */
TriangleMesh readMesh(const std::string& path, const CloudOptions& options = {});

/** \brief The same from what was read. \throw Failure, without the file's name in it */
TriangleMesh makeMesh(Shape shape);

/** \brief Edges that an odd number of triangles has: none where a mesh is closed. */
std::size_t openEdges(const TriangleMesh& mesh);

/** \brief Writes a binary PLY in double precision. */
void writePly(const std::string& path, const TriangleMesh& mesh);

} // namespace pcl_sq::app
