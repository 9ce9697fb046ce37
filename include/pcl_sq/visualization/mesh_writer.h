// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/palette.h"
#include "pcl_sq/triangle_mesh.h"

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Writes a mesh; the path's ending chooses the format: .ply and .stl (binary),
 * .obj (text), .vtp (ParaView). Written to a temporary name and renamed.
 * \param[in] mesh lengths in metres; .ply, .stl and .vtp hold single precision
 * \throws pcl_sq::Exception for another ending, an empty mesh, an index outside of the
 * vertices or a file that cannot be written
 * \ingroup pcl_sq */
PCL_SQ_EXPORTS void writeMesh(const std::string& path, const TriangleMesh& mesh);

/** \brief Writes several meshes as one, such as the parts of an object.
 *
 * .ply and .vtp get the colours per vertex, .vtp also the part's number per triangle;
 * .obj and .stl cannot hold colours.
 * \param[in] colors one per part, or empty for partColor()
 * \throws pcl_sq::Exception as above, and if the numbers of parts and colours differ */
PCL_SQ_EXPORTS void writeMesh(const std::string& path,
                              const std::vector<TriangleMesh>& parts,
                              const std::vector<Color>& colors = {});

} // namespace pcl_sq
