// SPDX-License-Identifier: BSD-3-Clause
// Private. A piece of an object: its points, its part of the outline and its fit.
#pragma once

#include "pcl_sq/fit_object.h"

namespace pcl_sq::detail {

/** \brief A plane that separates two pieces; through the camera's centre where there is
 * one, so that it is a line of the image as well. */
struct Cut {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
  double side(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
  Cut flipped() const { return {-normal, -offset}; }
};

struct Piece {
  std::vector<int> points; ///< columns of the observed object's points
  std::vector<ContourPoint> contour;
  std::vector<Eigen::Vector2d> pixels; ///< some of the piece's, for its width
  std::vector<TangentPlane> ends;      ///< where cuts end it, roughly
  bool stands = true;                  ///< whether it may reach the table
  ViewFit fit;
  double covered = 0.0;  ///< cost of the free pixels that it covers
  double misfit = 1e300; ///< cost of points, planes and free pixels
  double score = 1e300;  ///< M17: smaller is better; pieces add up
  /** \brief The same two without a taper or bend: what those explain two parts may
   * explain better, and the quick fits of cuts know neither. */
  double straight_misfit = 1e300, straight_score = 1e300;
  bool final = false; ///< no cut improved it
};

/** \brief What all pieces of an object share. */
struct PieceContext {
  const ObservedObject& observed;
  const ObjectFitOptions& options;
  double noise;                     ///< of the points [m]
  std::vector<float> precision;     ///< of the observed points; may be empty
  std::vector<TangentPlane> limits; ///< half-spaces that hold every part, roughly
  int pixel_step = 1;               ///< between two of Piece::pixels
};

/** \brief Observed points. */
Eigen::Matrix3Xd gather(const PieceContext& context, const std::vector<int>& columns);

/** \brief Half the diagonal of the box of points [m]. */
double halfDiagonal(const Eigen::Matrix3Xd& points);

/** \brief Pixels between two of Piece::pixels, so that those of all are not too many.
 */
int pixelStep(const ObservedObject& observed);

/** \brief The whole object as one piece. */
Piece wholePiece(const PieceContext& context);

/** \brief The part of a piece on the positive side of a cut; empty points if too small.
 */
Piece cutPiece(const PieceContext& context, const Piece& piece, const Cut& cut);

/** \brief Half the diagonal of the box of a piece's points [m]. */
double halfSize(const PieceContext& context, const Piece& piece);

/** \brief A cut moved along its normal where the object is [m]; it stays a line of the
 * image where there is a camera. */
Cut shiftedCut(const PieceContext& context, const Cut& cut, double distance);

/** \brief Where a piece may be cut: jumps of its width along its axes. */
std::vector<Cut> proposeCuts(const PieceContext& context, const Piece& piece);

/** \brief How many of a vessel's points lie off it, outside. */
std::size_t pointsOff(const PieceContext& context, const Piece& piece);

/** \brief Parts what stands off a vessel, a handle, from its body. \return whether
 * enough does, and hangs together */
[[nodiscard]] bool standsOff(const PieceContext& context,
                             const Piece& piece,
                             Piece& body_piece,
                             Piece& handle);

/** \brief Median distance of a piece's points to its model, as a standard deviation
 * [m]. */
double scatter(const PieceContext& context, const Piece& piece);

/** \brief Fits a handle and scores it; the ellipsoid around its points where no fit
 * comes near them. */
void fitHandle(const PieceContext& context, Piece& handle, const Superquadric& body);

enum class Effort {
  QUICK,    ///< general shape, few starts
  START,    ///< general shape, all starts: where AGAIN goes on from
  FULL,     ///< all shapes, all starts
  AGAIN,    ///< all shapes from the last fit
  SAME,     ///< the shape that it has, from the last fit
  STRAIGHT, ///< the same without tapers, walls and bends: cuts are ranked by these
  UNBENT,   ///< the same without bends, which a cut is to pay without
  FINAL     ///< the same, and held off the free pixels
};

/** \brief Fits a piece and scores it.
 * \param[in] coaxial another part whose axis it may share, or nullptr */
void fitPiece(const PieceContext& context,
              Piece& piece,
              Effort effort,
              const Superquadric* coaxial = nullptr);

/** \brief Whether holding a piece off the free pixels is worth a fit. */
[[nodiscard]] bool coversFreeSpace(const Piece& piece);

/** \brief Two pieces as one; not fitted. */
Piece mergePieces(const Piece& a, const Piece& b);

/** \brief Noise of the points from their distance to their neighbours' planes [m]. */
double localNoise(const Eigen::Matrix3Xd& points, double effective_points);

} // namespace pcl_sq::detail
