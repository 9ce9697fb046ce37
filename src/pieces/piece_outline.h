// SPDX-License-Identifier: BSD-3-Clause
// Private. What of an object's outline belongs to a piece of it.
#pragma once

#include "pieces/piece.h"

namespace pcl_sq::detail {

/** \brief Sine of the angle of a pixel's ray above a plane through the camera's centre:
 * the ray itself would have to be turned into the world first. */
class AngleAbove {
public:
  AngleAbove(const PinholeCamera& camera, const Eigen::Vector3d& normal)
      : normal_(camera.rotation.transpose() * normal), center_(camera.cx, camera.cy),
        per_pixel_(1.0 / camera.fx, 1.0 / camera.fy) {}
  double operator()(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d d = (pixel - center_).cwiseProduct(per_pixel_);
    return (normal_.head<2>().dot(d) + normal_.z()) / std::sqrt(d.squaredNorm() + 1.0);
  }

private:
  Eigen::Vector3d normal_;
  Eigen::Vector2d center_, per_pixel_;
};

/** \brief How far pixels are from a piece's joints to others, where its body's outline
 * need not be the object's: the sine of the angle, positive well beside all of them. */
class BesideJoints {
public:
  /** \param[in] size of the piece [m] */
  BesideJoints(const ObservedObject& o, const Piece& piece, double size);
  double operator()(const Eigen::Vector2d& pixel) const;

private:
  std::vector<AngleAbove> angles_;
  double joint_;
};

/** \brief Width of the strip at a cut in which a piece has no outline of its own; the
 * sine of its angle. */
double stripWidth(const ObservedObject& o);

/** \brief A piece's outline without its joints to other pieces. */
std::vector<ContourPoint>
outlineBesideJoints(const ObservedObject& o, const Piece& piece, double size);

} // namespace pcl_sq::detail
