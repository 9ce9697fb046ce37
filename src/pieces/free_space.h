// SPDX-License-Identifier: BSD-3-Clause
// Private. Pixels that show the background hold a part down (M11).
#pragma once

#include "pieces/body_outline.h"
#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Free pixels that a model covers. */
struct Covered {
  double cost = 0.0;
  /** \brief Planes through the rays that part them from the body: a convex body misses
   * a line exactly if there is one. */
  std::vector<TangentPlane> limits;
};

/** \brief M11: what a body covers of the pixels that show what is behind it.
 * \param[in] outline of the body, or that of none: it only spares searches */
Covered coveredFreeSpace(const PieceContext& context,
                         const Superquadric& body,
                         const BodyOutline& outline);

/** \brief The same with an outline of its own where that is worth it. */
Covered coveredFreeSpace(const PieceContext& context, const Superquadric& body);

/** \brief M11: free pixels that a body covers, and those of a piece that it leaves
 * open: its rays miss what they show. */
class FreeSpaceCost {
public:
  FreeSpaceCost(const PieceContext& context, const Piece& piece);
  double operator()(const Superquadric& body) const;

private:
  double missed(const BodyOutline& outline) const;

  const PieceContext& context_;
  std::vector<Eigen::Vector3d> rays_; ///< of pixels well inside the piece
  double weight_ = 0.0;               ///< of a pixel
};

/** \brief Cost of a body that reaches beyond planes. */
double hingeCost(const std::vector<TangentPlane>& limits, const Superquadric& body);

} // namespace pcl_sq::detail
