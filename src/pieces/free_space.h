// SPDX-License-Identifier: BSD-3-Clause
// Private. Pixels that show the background hold a part down (M11).
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Free pixels that a model covers. */
struct Covered {
  double cost = 0.0;
  /** \brief Planes through the rays that part them from the body: a convex body misses
   * a line exactly if there is one. */
  std::vector<TangentPlane> limits;
};

/** \brief M11: what a body covers of the pixels that show what is behind it. */
Covered coveredFreeSpace(const PieceContext& context, const Superquadric& body);

/** \brief M11: what a body leaves open of a piece's pixels: its rays miss what they
 * show. */
double
missedPixels(const PieceContext& context, const Piece& piece, const Superquadric& body);

/** \brief Cost of a body that reaches beyond planes. */
double hingeCost(const std::vector<TangentPlane>& limits, const Superquadric& body);

} // namespace pcl_sq::detail
