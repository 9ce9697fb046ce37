// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/mesh_writer.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/file_io.h"
#include "visualization/files/mesh_bytes.h"
#include "visualization/frame_renderer.h"

namespace pcl_sq {
namespace {

const std::string WHO = "pcl_sq::writeMesh";

void check(const std::vector<TriangleMesh>& parts) {
  bool empty = true;
  for (const TriangleMesh& part : parts) {
    for (const Eigen::Vector3d& v : part.vertices)
      if (!v.allFinite())
        throw Exception("[" + WHO + "] a vertex is not finite; repair the mesh.");
    for (const auto& triangle : part.triangles)
      for (const std::uint32_t index : triangle)
        if (index >= part.vertices.size())
          throw Exception("[" + WHO +
                          "] a triangle's vertex does not exist; repair the mesh.");
    empty = empty && part.triangles.empty();
  }
  if (empty)
    throw Exception("[" + WHO + "] the mesh is empty; there is nothing to write.");
}

std::string bytesOf(const std::string& format,
                    const std::vector<TriangleMesh>& parts,
                    const std::vector<Color>& colors) {
  check(parts);
  if (format == ".ply")
    return plyBytes(parts, colors);
  if (format != ".vtp")
    return format == ".stl" ? stlBytes(parts) : objBytes(parts);
  std::string bytes = vtkPart(WHO).vtpBytes(parts, colors);
  if (bytes.empty())
    throw Exception("[" + WHO +
                    "] the mesh is too large for its format; make it coarser.");
  return bytes;
}

void write(const std::string& path,
           const std::vector<TriangleMesh>& parts,
           const std::vector<Color>& colors) {
  const std::string format = formatOf(path, ".ply");
  if (format != ".ply" && format != ".obj" && format != ".stl" && format != ".vtp")
    throw Exception("[" + WHO + "] " + path +
                    " has no ending of a mesh format; use .ply, .obj, .stl or .vtp.");
  std::string why;
  if (!writeFile(path, bytesOf(format, parts, colors), &why))
    throw Exception("[" + WHO + "] " + why + ".");
}

} // namespace

void writeMesh(const std::string& path, const TriangleMesh& mesh) {
  write(path, {mesh}, {});
}

void writeMesh(const std::string& path,
               const std::vector<TriangleMesh>& parts,
               const std::vector<Color>& colors) {
  if (!colors.empty() && colors.size() != parts.size())
    throw Exception("[" + WHO + "] " + std::to_string(parts.size()) + " parts have " +
                    std::to_string(colors.size()) +
                    " colours; give one per part or none.");
  std::vector<Color> used = colors;
  for (std::size_t i = used.size(); i < parts.size(); ++i)
    used.push_back(partColor(i));
  write(path, parts, used);
}

} // namespace pcl_sq
