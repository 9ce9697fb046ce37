// SPDX-License-Identifier: BSD-3-Clause
// Private. Parts of an object that is seen from all sides, judged together: where its
// points are and where there are none tell more than each part's own points do.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Splits an object without a camera while that pays, its parts fitted to the
 * points nearest to each.
 * \param[in] whole all points, fitted
 * \param[in] wanted largest number of parts, or the number itself
 * \param[in] exactly whether \a wanted is the number
 * \param[in] min_gain of the score, for one more part */
std::vector<Piece> splitWholeCloud(const PieceContext& context,
                                   Piece whole,
                                   int wanted,
                                   bool exactly,
                                   double min_gain);

} // namespace pcl_sq::detail
