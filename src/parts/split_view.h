// SPDX-License-Identifier: BSD-3-Clause
// Private. The parts of an object that a camera saw: cut while that pays.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Cuts pieces of an object that a camera saw while that pays.
 * \param[in] wanted largest number of parts, or the number itself where the options ask
 * for one
 * \param[in] min_gain of the score, for one more part */
void splitView(const PieceContext& context,
               std::vector<Piece>& pieces,
               int wanted,
               double min_gain);

/** \brief Independent observations among a piece's points. */
double observations(const PieceContext& context, const Piece& piece);

/** \brief Axis that other parts may share: a solid of revolution's, else nullptr. */
const Superquadric* axisOf(const Piece& piece);

/** \brief The solid of revolution with the most points; the number of pieces if there
 * is none. */
std::size_t largestOfRevolution(const std::vector<Piece>& pieces);

} // namespace pcl_sq::detail
