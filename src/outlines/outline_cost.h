// SPDX-License-Identifier: BSD-3-Clause
// Private. Where the object's outline and that of all its parts contradict each other.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Pixels of the object, on a coarse grid and well inside its outline, that no
 * part comes near. */
std::vector<Eigen::Vector2d> pixelsLeft(const PieceContext& context,
                                        const std::vector<Piece>& pieces);

/** \brief Cost of one pixel of that grid that is left, or covered and free. */
double contradictionCost(const ObservedObject& observed);

/** \brief Cost of all contradictions: of the gap's pixels that the parts cover, and of
 * those of the object that they leave. */
double outlineCost(const PieceContext& context, const std::vector<Piece>& pieces);

/** \brief What the parts leave unexplained, points and outline together. */
double scoreOf(const PieceContext& context, const std::vector<Piece>& pieces);

} // namespace pcl_sq::detail
