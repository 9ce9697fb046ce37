// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/open_mesh.h"
#include "mesh/surface_remesher.h"

#include <algorithm>

namespace pcl_sq {

namespace detail {

namespace {

constexpr int START_RESOLUTION = 40; ///< shows how parts meet; splitting does the rest
constexpr int START_DIVISIONS = 24;  ///< of a single part
constexpr double WELDED = 0.35;      ///< of a cell: vertices so near become one
constexpr int TRIES = 4;
/** \brief Share of the tolerance that the samples on a triangle may use: between them
 * the surface may be a little farther. */
constexpr double SAMPLED = 0.75;

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
PartMesh closedMarch(const MultiSuperquadric& model, int resolution) {
  PartMesh mesh = marchUnion(model, resolution);
  for (int i = 1; i < TRIES && !isClosed(mesh.mesh); ++i)
    mesh = marchUnion(model, resolution + i);
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
  PartMesh start;
  if (model.size() == 1) {
    start.mesh = meshSuperquadric(model.parts[0], START_DIVISIONS);
    start.part.assign(start.mesh.triangles.size(), 0);
  } else {
    start = closedMarch(model, START_RESOLUTION);
  }
  if (!isClosed(start.mesh))
    return start.mesh;
  SurfaceRemesher remesher(start, model, SAMPLED * tolerance);
  if (model.size() > 1)
    remesher.weld(WELDED * longestSide(model) / START_RESOLUTION);
  remesher.refine();
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
  const detail::PartMesh start = detail::closedMarch(*this, resolution);
  if (!detail::isClosed(start.mesh))
    return start.mesh;
  const double cell = detail::longestSide(*this) / resolution;
  detail::SurfaceRemesher remesher(start, *this, cell);
  remesher.weld(0.5 * detail::WELDED * cell); // the resolution asked for is kept
  return remesher.mesh();
}

} // namespace pcl_sq
