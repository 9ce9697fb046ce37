// SPDX-License-Identifier: BSD-3-Clause
// Private. Parts of a whole cloud and what they cost together (M19).
#pragma once

#include "pieces/piece.h"

#include <memory>

namespace pcl_sq::detail {

struct BodyTrace;

/** \brief A piece, and what its body is to all points: found once, used by each score
 * of a set of parts that it is in. */
struct Part {
  Piece piece;
  std::shared_ptr<const BodyTrace> trace;
};

/** \brief Fits a part's piece. */
void fitPart(const PieceContext& context, Part& part, Effort effort);

/** \brief After a part's piece was fitted: looks whether the body leaves the points'
 * box, and holds it within. */
void traceWithinBox(const PieceContext& context, Part& part);

/** \brief After a part's piece was fitted elsewhere. */
void traceAgain(const PieceContext& context, Part& part);

/** \brief Signed distance of an observed point to a part's body [m]. */
[[nodiscard]] double distanceOf(const Part& part, int column);

/** \brief Tells bodies apart, also those that are gone. */
[[nodiscard]] std::size_t traceNumber(const Part& part);

/** \brief Of each of some points the part with the nearest surface. */
[[nodiscard]] std::vector<std::size_t> nearestParts(const std::vector<Part>& parts,
                                                    const std::vector<int>& points);

/** \brief M19: minus twice the logarithm of the likelihood, plus the parameters' price;
 * smaller is better.
 *
 * Points are spread evenly over the outer surface, with noise: a surface without points
 * costs as much as points without a surface. */
[[nodiscard]] double scoreOf(const PieceContext& context,
                             const std::vector<const Part*>& parts);

/** \brief More than cuts of a part can take from the score, their own price left out:
 * all that its points lie off it beyond the noise, and all of its surface that has no
 * points. */
[[nodiscard]] double mostGain(const PieceContext& context, const Part& part);

/** \brief Share of a body's surface that has points of the cloud beside it. */
[[nodiscard]] double covered(const PieceContext& context, const Superquadric& body);

/** \brief Gives each point to the part with the nearest surface; a part keeps what
 * noise cannot tell. \return whether a point changed its part and no part lost nearly
 * all */
[[nodiscard]] bool assignPoints(const PieceContext& context, std::vector<Part>& parts);

} // namespace pcl_sq::detail
