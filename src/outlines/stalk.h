// SPDX-License-Identifier: BSD-3-Clause
// Private. What sticks out of a body, and no part explains: stalks, knobs, spouts.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Gives what sticks out of all parts' outlines and hangs together a part of its
 * own, a round rod, where that explains points and outline better. An apple's stalk has
 * too few points that cuts would see it, and its outline is the only one there is.
 * \param[in,out] pieces fitted
 * \param[in] wanted parts at most */
void addStalks(const PieceContext& context, std::vector<Piece>& pieces, int wanted);

} // namespace pcl_sq::detail
