// SPDX-License-Identifier: BSD-3-Clause
#include "scene/mesh_reader.h"

#include "command_line/app.h"
#include "files/cloud_io.h"
#include "files/files.h"
#include "input/shape.h"
#include "report/text.h"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

namespace pcl_sq::app {
namespace {

/** \brief Makes one of equal vertices (STL repeats them), in the order of their first
 * appearance; unused ones stay. */
void weld(TriangleMesh& mesh) {
  const std::vector<Eigen::Vector3d> all = std::move(mesh.vertices);
  std::vector<std::uint32_t> order(all.size()), first(all.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto less = [&all](std::uint32_t i, std::uint32_t k) {
    const Eigen::Vector3d &a = all[i], &b = all[k];
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] != b[axis])
        return a[axis] < b[axis];
    return i < k;
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && all[order[k]] == all[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  mesh.vertices.clear();
  std::vector<std::uint32_t> place(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i)
    if (first[i] == i) {
      place[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(all[i]);
    }
  for (auto& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle)
      corner = place[first[corner]];
}

} // namespace

TriangleMesh makeMesh(Shape shape) {
  if (shape.triangles.empty())
    throw Failure("it holds no triangle");
  // squares and cubes of lengths must stay numbers, with room for the unit
  constexpr double FARTHEST = 1e9;
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    if (!(shape.points[i].array().abs() <= FARTHEST).all()) // NaN neither
      throw Failure("its vertex " + std::to_string(i + 1) +
                    " has a coordinate that is no length");
  TriangleMesh mesh;
  mesh.vertices = std::move(shape.points);
  mesh.triangles = std::move(shape.triangles);
  weld(mesh);
  return mesh;
}

TriangleMesh readMesh(const std::string& path, const CloudOptions& options) {
  Shape shape = loadShape(path);
  try {
    TriangleMesh mesh = makeMesh(std::move(shape));
    for (Eigen::Vector3d& v : mesh.vertices)
      v *= options.scale();
    return mesh;
  } catch (const Failure& failure) {
    throw Failure("cannot read '" + printable(path) + "': " + failure.what() +
                  "; give another mesh file.");
  }
}

std::size_t openEdges(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    open += static_cast<std::size_t>((next - edge) % 2);
    edge = next;
  }
  return open;
}

void writePly(const std::string& path, const TriangleMesh& mesh) {
  std::ostringstream out;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& v : mesh.vertices)
    out.write(reinterpret_cast<const char*>(v.data()), 3 * sizeof(double));
  for (const auto& t : mesh.triangles) {
    const char three = 3;
    out.write(&three, 1);
    out.write(reinterpret_cast<const char*>(t.data()), 3 * sizeof(std::uint32_t));
  }
  writeOutput(path, out.str());
}

} // namespace pcl_sq::app
