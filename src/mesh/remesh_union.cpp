// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/open_mesh.h"
#include "mesh/surface_remesher.h"

#include <algorithm>

namespace pcl_sq {

namespace detail {

namespace {

constexpr int TRIES = 4;
/** \brief Shares of the tolerance: of the fine mesh that is coarsened, and of the
 * samples on a triangle, between which the surface may be a little farther. */
constexpr double MARCHED = 0.75, SAMPLED = 0.75;
constexpr double FLAT_CELLS = 16.0; ///< along the longest side where nothing bends
constexpr double WELDED = 0.18;     ///< of a cell: vertices so near become one
constexpr double BENT = 0.25;       ///< of a cell may a surface be off
constexpr double ODD = 0.973;       ///< so that no face touches a corner of the grid

bool isClosed(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ways, back;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      ways.emplace_back(t[i], t[(i + 1) % 3]);
      back.emplace_back(t[(i + 1) % 3], t[i]);
    }
  std::sort(ways.begin(), ways.end());
  std::sort(back.begin(), back.end());
  return ways == back && std::adjacent_find(ways.begin(), ways.end()) == ways.end();
}

/** \brief Where surfaces touch a grid's corners to the last bit the clipped polygons
 * may not meet; another grid does not touch there. */
PartMesh closedMarch(const MultiSuperquadric& model, double tolerance, double longest) {
  PartMesh mesh = marchUnion(model, tolerance, longest *= ODD);
  for (int i = 1; i < TRIES && !isClosed(mesh.mesh); ++i)
    mesh = marchUnion(model, tolerance, longest *= ODD);
  return mesh;
}

double longestSide(const MultiSuperquadric& model) {
  return model.boundingBox().sizes().maxCoeff();
}

} // namespace

TriangleMesh remeshUnion(const MultiSuperquadric& model, double tolerance) {
  if (model.empty())
    return {};
  if (hasOpenParts(model)) {
    // chords of a circle of the object's size miss it by no more
    const double chords = std::sqrt(longestSide(model) / tolerance);
    return addOpenParts(model,
                        std::clamp(static_cast<int>(chords), 8, 128),
                        remeshUnion(withoutOpenParts(model), tolerance));
  }
  const PartMesh start =
      closedMarch(model, MARCHED * tolerance, longestSide(model) / FLAT_CELLS);
  if (!isClosed(start.mesh))
    return start.mesh;
  SurfaceRemesher remesher(start, model, SAMPLED * tolerance);
  remesher.weld(MARCHED * tolerance);
  remesher.coarsen();
  return remesher.mesh();
}

} // namespace detail

TriangleMesh MultiSuperquadric::meshUnion(int resolution) const {
  if (empty())
    return {};
  if (detail::hasOpenParts(*this))
    return detail::addOpenParts(*this,
                                std::clamp(resolution / 2, 8, 128),
                                detail::withoutOpenParts(*this).meshUnion(resolution));
  const double cell = detail::longestSide(*this) / std::clamp(resolution, 8, 512);
  const detail::PartMesh start = detail::closedMarch(*this, detail::BENT * cell, cell);
  if (!detail::isClosed(start.mesh))
    return start.mesh;
  detail::SurfaceRemesher remesher(start, *this, cell);
  remesher.weld(detail::WELDED * cell); // the resolution asked for is kept
  return remesher.mesh();
}

} // namespace pcl_sq
