// SPDX-License-Identifier: BSD-3-Clause
// Private. What no part of an object explains.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Cells of the outline's coarse grid that hang together and hold pixels that no
 * part comes near, or points that stand off all parts. */
struct LeftOver {
  std::vector<Eigen::Vector2d> cells; ///< the first pixel of each
  double worth = 0.0;                 ///< what they cost while nothing explains them
  std::vector<int> off; ///< columns of all points that stand off all parts
};

/** \brief The set of cells that costs most; none where all is explained. */
LeftOver leftOver(const PieceContext& context, const std::vector<Piece>& pieces);

/** \brief The object's pixels in and beside those cells that show what stands off, or
 * that a body leaves: up to the body, and to the object's outline. */
std::vector<Eigen::Vector2d>
pixelsOf(const PieceContext& context, const LeftOver& left, const Superquadric& body);

} // namespace pcl_sq::detail
