// SPDX-License-Identifier: BSD-3-Clause
// Private. Pieces of things: what hangs together without doubt, and which of it is one
// thing.
#pragma once

#include "patches/superpixels.h"

#include <map>

namespace pcl_sq::detail {

constexpr double FOLD = 0.7; ///< angle of normals [rad], concave: surely a fold

/** \brief Superpixels of one colour that hang together without a jump or a crease. */
struct Patch {
  std::vector<int> pixels;
  PieceSums sums;
  double low = 0.0, high = 0.0; ///< heights above the table of all but strays [m]
};

/** \brief Where a patch stands: a circle on the table. */
struct Footprint {
  Eigen::Vector3d middle;
  double radius = 0.0; ///< of a ring; more of a disc
};
[[nodiscard]] Footprint footprintOf(const TableModel& table, const Patch& patch);

struct Patches {
  std::vector<Patch> list;
  std::vector<int> of_pixel;                     ///< -1: none
  std::map<std::pair<int, int>, Border> borders; ///< smaller index first
};

/** \brief Joins superpixels where colour, depth and curvature say one surface. */
[[nodiscard]] Patches patchesOf(const SceneView& view, const Superpixels& superpixels);

/** \brief Whether pixels are but a rim, a few wide: no thing by itself. */
[[nodiscard]] bool isThin(const std::vector<int>& pixels, int width, int height);

/** \brief Leaves out what lies about alone: a pixel of a thing's colour far from it
 * would be its outline. */
[[nodiscard]] std::vector<int>
withoutStrays(const std::vector<int>& pixels, int width, int height);

/** \brief What is seen between two patches. */
struct Between {
  bool background = false;  ///< something beside them that hides neither
  bool hidden = false;      ///< nothing but what hides them
  bool apart_above = false; ///< the same, but background between their highest places
};

/** \brief Looks along the line between two patches where they are nearest to each
 * other, and along that between their highest places: what parts one thing in two hides
 * it from its top to its foot, unless it is bent. */
[[nodiscard]] Between between(const SceneView& view, const Patch& a, const Patch& b);

/** \brief Joins patches that are one thing. */
[[nodiscard]] std::vector<Patch> joinPatches(const SceneView& view, Patches patches);

} // namespace pcl_sq::detail
