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
  BodyOutline(const Superquadric& body, const Eigen::Vector3d& eye, int planes) {
    constexpr int ROUNDS = 4;
    const Eigen::Vector3d towards = body.center - eye;
    const double distance = towards.norm();
    const double nearest = distance - body.halfSizes().norm();
    if (!(nearest > 0.0))
      return;
    const Eigen::Vector3d ahead = towards / distance, right = ahead.unitOrthogonal(),
                          down = ahead.cross(right);
    for (int k = 0; k < planes; ++k) {
      const double angle = 2.0 * M_PI * k / planes;
      const Eigen::Vector3d side = std::cos(angle) * right + std::sin(angle) * down;
      Eigen::Vector3d normal = side;
      double sine = 0.0;
      for (int round = 0; round < ROUNDS; ++round) {
        sine = std::min(body.support(normal) / distance, 0.9);
        normal = std::sqrt(1.0 - sine * sine) * side - sine * ahead;
      }
      const double beyond = body.support(normal) - sine * distance;
      planes_.push_back({normal, std::max(beyond, 0.0) / nearest});
    }
  }

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

} // namespace pcl_sq::detail
