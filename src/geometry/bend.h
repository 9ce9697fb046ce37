// SPDX-License-Identifier: BSD-3-Clause
// Private. Bodies whose z axis is bent to a circle.
#pragma once

#include "geometry/open_body.h"

#include <array>

namespace pcl_sq::detail {

/** \brief Where bending takes the section at a height: its middle lies on the circle,
 * its plane stands upright on it. */
struct BentFrame {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(); ///< own frame [m]
  /** \brief Columns: where the own axes point there, the third along the circle. */
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};
BentFrame bentFrame(const Superquadric& s, double z);

/** \brief Where bending takes a place; both in the own frame. */
Eigen::Vector3d bent(const Superquadric& s, const Eigen::Vector3d& unbent);

/** \brief Inverse of bent(), the angle around the circle in (-pi, pi]. */
Eigen::Vector3d unbent(const Superquadric& s, const Eigen::Vector3d& local);

/** \brief How much longer than along the axis a fibre at a place is; zero at the
 * circle's centre. */
double fibre(const Superquadric& s, const Eigen::Vector3d& unbent);

/** \brief How fast a place of the bent body moves as the curvature grows; own frame. */
Eigen::Vector3d bendVelocity(const Superquadric& s, const Eigen::Vector3d& unbent);

/** \brief Half the sides of a box in the own axes, around the centre, that holds the
 * bent body. */
Eigen::Vector3d bentHalfSizes(const Superquadric& s);

/** \brief The reason why a bend is out of range, nullptr if it is not. */
const char* invalidBend(const Superquadric& s);

/** \brief A point of a bent body that reaches farthest along a direction. */
struct BentContact {
  double reach = 0.0;     ///< along the direction, from the centre
  Eigen::Vector3d at;     ///< own frame
  Eigen::Vector3d unbent; ///< before bending
  double sine = 0.0;      ///< of its latitude, signed
  double cosine = 1.0;    ///< and its cosine
  Eigen::Vector2d shares; ///< cos^2 and sin^2 of its angle in the section
};

/** \brief The support function of a bent body, or of a stretch of one, cut into slices;
 * those that each search begins with are made once for all directions. */
class BentSupport {
public:
  /** \param[in] s is kept by reference
   * \param[in] low, high heights over a3 between which contacts are looked for */
  explicit BentSupport(const Superquadric& s, double low = -1.0, double high = 1.0);

  /** \brief The contact in a direction in the own frame. */
  BentContact contact(const Eigen::Vector3d& direction) const;

private:
  static constexpr int SLICES = 24;
  /** \brief Where a slice is: what does not depend on the direction. */
  struct Slice {
    double sine, cosine;                         ///< of its latitude, the sine signed
    double height, scale;                        ///< over a3, of its section
    double arc_sine, arc_cosine, inwards, along; ///< of the bent axis there
  };
  struct Touching;
  Slice at(double t) const;
  Touching touching(const Slice& at, const Eigen::Vector3d& direction) const;

  const Superquadric& s_;
  Eigen::Vector3d towards_; ///< the circle's centre
  double begin_, end_, step_;
  std::array<Slice, SLICES + 1> slices_;
};

/** \brief Into how many stretches a bent body is cut to be as good as convex.
 * \param[in] half_angle largest part of the circle to either side of a stretch's middle
 * [rad] */
int convexPieces(const Superquadric& s, double half_angle = 0.35);

/** \brief Integrals of 1, p and p p^T over a bent body in its own frame (Pappus). */
struct BentMoments {
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};
BentMoments bentMoments(const Superquadric& s);

/** \brief The place of a bent body's surface nearest to another, own frame. */
Eigen::Vector3d nearestOnBent(const Superquadric& s, const Eigen::Vector3d& local);

} // namespace pcl_sq::detail
