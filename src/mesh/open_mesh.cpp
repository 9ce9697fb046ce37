// SPDX-License-Identifier: BSD-3-Clause
// The surface of a body with a rim: rings from the pole below over the rim to the
// floor.
#include "mesh/open_mesh.h"

#include "geometry/open_body.h"
#include <algorithm>
#include <iterator>

namespace pcl_sq::detail {

TriangleMesh meshOpenBody(const Superquadric& s, int divisions) {
  std::vector<Ring> rings;
  for (const auto& stretch : ringsOf(s, divisions))
    for (const Ring& ring : stretch)
      if (rings.empty() || ring.section.a != rings.back().section.a ||
          ring.z != rings.back().z)
        rings.push_back(ring);
  const auto around = static_cast<std::uint32_t>(8 * ((divisions + 1) / 2));
  TriangleMesh mesh;
  std::vector<std::uint32_t> first; // vertex of each ring
  for (const Ring& ring : rings) {
    first.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    const std::uint32_t count = ring.section.empty() ? 1 : around;
    for (std::uint32_t k = 0; k < count; ++k)
      mesh.vertices.push_back(
          s.toWorld(onRing(ring, s.epsilon2, 2.0 * M_PI * k / around)));
  }
  const auto at = [&](std::size_t ring, std::uint32_t k) {
    return first[ring] + (rings[ring].section.empty() ? 0 : k % around);
  };
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::uint32_t k = 0; k < around; ++k) {
      if (!rings[i].section.empty())
        mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      if (!rings[i + 1].section.empty())
        mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  return mesh;
}

bool hasOpenParts(const MultiSuperquadric& model) {
  return std::any_of(model.parts.begin(), model.parts.end(), [](const auto& part) {
    return part.isCut();
  });
}

MultiSuperquadric withoutOpenParts(const MultiSuperquadric& model) {
  MultiSuperquadric others;
  std::copy_if(model.parts.begin(),
               model.parts.end(),
               std::back_inserter(others.parts),
               [](const Superquadric& part) { return !part.isCut(); });
  return others;
}

TriangleMesh
addOpenParts(const MultiSuperquadric& model, int divisions, TriangleMesh mesh) {
  for (const Superquadric& part : model.parts) {
    if (!part.isCut())
      continue;
    const TriangleMesh own = meshOpenBody(part, divisions);
    const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), own.vertices.begin(), own.vertices.end());
    for (const auto& t : own.triangles)
      mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return mesh;
}

} // namespace pcl_sq::detail
