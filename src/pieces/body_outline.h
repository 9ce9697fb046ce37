// SPDX-License-Identifier: BSD-3-Clause
// Private. A body's outline as planes through the camera.
#pragma once

#include "pcl_sq/superquadric.h"

#include <algorithm>
#include <vector>

namespace pcl_sq::detail {

/** \brief Planes through the camera that touch a body all around: a ray beyond one of
 * them misses it, which costs no search along the ray. */
class BodyOutline {
public:
  /** \brief That of no body: no ray misses it for sure. */
  BodyOutline() = default;
  /** \param[in] eye the camera; within the body's reach there is no outline */
  BodyOutline(const Superquadric& body, const Eigen::Vector3d& eye, int planes);

  /** \brief Whether a ray, of unit length, is beyond one of the planes. */
  bool misses(const Eigen::Vector3d& ray) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
      return plane.normal.dot(ray) > plane.least;
    });
  }

  /** \brief Sine of the angle by which a ray, of unit length, lies beyond the plane
   * that it is farthest beyond; not positive where it may hit. */
  double sineBeyond(const Eigen::Vector3d& ray) const {
    double sine = -1.0;
    for (const Plane& plane : planes_)
      sine = std::max(sine, plane.normal.dot(ray) - plane.least);
    return sine;
  }

private:
  struct Plane {
    Eigen::Vector3d normal;
    double least; ///< sine of a ray's angle with the plane from which on it misses
  };
  std::vector<Plane> planes_;
};

/** \brief Whether rays from one place hit a body, filled up to its rim. Most rays are
 * clear of its outline, or go deep through it; only the others cost a search. */
class RayTest {
public:
  RayTest(const Superquadric& body, const Eigen::Vector3d& eye);
  /** \param[in] ray of unit length */
  bool hits(const Eigen::Vector3d& ray) const;

private:
  const Superquadric& body_;
  Eigen::Vector3d eye_;
  BodyOutline outline_;
};

} // namespace pcl_sq::detail
