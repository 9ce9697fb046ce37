// SPDX-License-Identifier: BSD-3-Clause
// Private. Gaps in an object through which the background is seen: the handle of a cup.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Where the object has a gap, takes a body and a ring of three parts instead of
 * the pieces if they explain points and outline better. Two convex parts leave no gap
 * in an outline, and cuts one by one see no gain in the first part of a ring: it takes
 * a joint hypothesis. \param[in,out] pieces fitted \param[in] min_gain in score that
 * four parts must have over the pieces */
void openGap(const PieceContext& context, std::vector<Piece>& pieces, double min_gain);

} // namespace pcl_sq::detail
