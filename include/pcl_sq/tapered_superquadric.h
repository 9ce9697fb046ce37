// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

namespace pcl_sq {

/** \brief A superquadric whose cross-section grows linearly along z (Solina & Bajcsy
 * 1990): a cup, a lampshade, a wedge.
 *
 * A point (x, y, z) of the superquadric's own frame goes to
 * \f[ \left( (k_x z / a_3 + 1)\, x,\; (k_y z / a_3 + 1)\, y,\; z \right) \f]
 * A type of its own rather than two more fields of Superquadric: a tapered body has
 * neither the convexity nor the centre of symmetry that the grasps, the support
 * function and the union rely on, and none of them can take one by mistake. The same
 * body turned by 180 degrees about x has the opposite taper.
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS TaperedSuperquadric {
  /** \brief Largest |kx|, |ky|; 1 would be an apex. */
  static constexpr double MAX_TAPER = 0.95;

  Superquadric shape; ///< before tapering; a1 and a2 are those at z = 0
  double kx = 0.0;    ///< relative growth of the section's x from z = 0 to z = a3
  double ky = 0.0;    ///< and of its y

  bool isTapered() const { return kx != 0.0 || ky != 0.0; }
  /** \brief Whether shape and taper are in range. \param[out] why the first violation
   * as a sentence (optional) */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;

  /** \brief Where tapering takes a point of \a shape; both in the cloud's frame. */
  Eigen::Vector3d tapered(const Eigen::Vector3d& point) const;
  /** \brief Inverse of tapered(). Beyond the apex, where there is none, the section is
   * taken to shrink no further than at MAX_TAPER. */
  Eigen::Vector3d untapered(const Eigen::Vector3d& point) const;

  /** \brief Gauge of \a shape at the untapered place: < 1 inside, 1 on the surface. */
  double gauge(const Eigen::Vector3d& point) const;
  bool contains(const Eigen::Vector3d& point) const { return gauge(point) <= 1.0; }
  /** \brief Point of the surface that belongs to \a point: the radial projection before
   * tapering, tapered. */
  Eigen::Vector3d radialProjection(const Eigen::Vector3d& point) const;
  /** \brief Signed distance to the foot point after one projection to the tangent plane
   * [m]; Superquadric::footPointDistance() where there is no taper. */
  double footPointDistance(const Eigen::Vector3d& point) const;

  /** \brief How far the body reaches from shape.center along a direction [m], times the
   * direction's length; exact to about 1e-9 of its size. A tapered body need not be
   * convex: this is the support function of its convex hull. With e2 > 1.98 that of
   * e2 = 1.98. */
  double support(const Eigen::Vector3d& direction) const;
  /** \brief The point of the surface that reaches farthest along a direction. */
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;

  /** \brief Volume [m^3]: the odd terms of the taper cancel, and kx ky times the second
   * moment along z over a3^2 comes on top. */
  double volume() const;
  /** \brief Centre of gravity in the cloud's frame [m], closed form. */
  Eigen::Vector3d centerOfGravity() const;
};

/** \brief Closed mesh of a tapered superquadric, see meshSuperquadric(). */
PCL_SQ_EXPORTS TriangleMesh meshSuperquadric(const TaperedSuperquadric& superquadric,
                                             int divisions = 24);

} // namespace pcl_sq
