// SPDX-License-Identifier: BSD-3-Clause
// Private. The meridian of an open vessel of revolution.
#pragma once

#include "pcl_sq/superquadric.h"

#include <array>

namespace pcl_sq::detail {

/** \brief A place of a vessel's meridian, (distance from the axis, height), with its
 * derivatives for ln a, ln a3, e1, k, rim, ln wall. */
struct ProfileVertex {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> d = Eigen::Matrix<double, 2, 6>::Zero();
  Eigen::Vector2d side = Eigen::Vector2d::Zero(); ///< to the next vertex
  double inverse_square = 0.0;                    ///< of the side's length; of none 0
};

/** \brief The meridian of a vessel as two polylines: what may be seen from outside (the
 * outer wall from the pole below to the rim, and the rim), and what through the opening
 * (the floor from its middle, and the inner wall up to the rim). */
struct VesselProfile {
  static constexpr int OUTER = 20, INNER = 12; ///< steps of the walls
  std::array<ProfileVertex, OUTER + 2> outside;
  std::array<ProfileVertex, INNER + 2> inside;

  explicit VesselProfile(const Superquadric& s);
  double rimHeight() const { return outside[OUTER].at.y(); }
  double opening() const { return inside[INNER + 1].at.x(); } ///< radius
};

} // namespace pcl_sq::detail
