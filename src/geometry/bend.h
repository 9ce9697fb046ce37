// SPDX-License-Identifier: BSD-3-Clause
// Private. Bodies whose z axis is bent to a circle.
#pragma once

#include "geometry/open_body.h"

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

/** \brief The support function's contact, of a body cut into slices; \a direction in
 * the own frame. \param[in] low, high heights over a3 between which it is looked for */
BentContact bentContact(const Superquadric& s,
                        const Eigen::Vector3d& direction,
                        double low = -1.0,
                        double high = 1.0);

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
