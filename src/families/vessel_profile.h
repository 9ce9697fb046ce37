// SPDX-License-Identifier: BSD-3-Clause
// Private. The meridian of an open vessel of revolution.
#pragma once

#include "pcl_sq/superquadric.h"

#include <algorithm>
#include <array>

namespace pcl_sq::detail {

/** \brief A place of a vessel's meridian, (distance from the axis, height), with its
 * derivatives for ln a, ln a3, e1, k, rim, ln wall. */
struct ProfileVertex {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> d = Eigen::Matrix<double, 2, 6>::Zero();
};

/** \brief The chords of a polyline, laid out so that the distances to all of them are
 * found at once. */
template <std::size_t COUNT>
struct Chords {
  std::array<double, COUNT> x{}, y{};           ///< where each begins
  std::array<double, COUNT> side_x{}, side_y{}; ///< to the next vertex
  std::array<double, COUNT> inverse_square{};   ///< of the side's length; of none 0

  explicit Chords(const std::array<ProfileVertex, COUNT + 1>& line) {
    for (std::size_t i = 0; i < COUNT; ++i) {
      x[i] = line[i].at.x();
      y[i] = line[i].at.y();
      side_x[i] = line[i + 1].at.x() - x[i];
      side_y[i] = line[i + 1].at.y() - y[i];
      const double square = side_x[i] * side_x[i] + side_y[i] * side_y[i];
      inverse_square[i] = square > 0.0 ? 1.0 / square : 0.0;
    }
  }
  /** \brief Where a chord comes nearest to a place, over its length. */
  double shareAt(std::size_t i, double to_x, double to_y) const {
    const double t = (to_x * side_x[i] + to_y * side_y[i]) * inverse_square[i];
    return std::min(std::max(t, 0.0), 1.0);
  }
  void squaresTo(const Eigen::Vector2d& p, std::array<double, COUNT>& squares) const {
    for (std::size_t i = 0; i < COUNT; ++i) {
      const double to_x = p.x() - x[i], to_y = p.y() - y[i];
      const double share = shareAt(i, to_x, to_y);
      const double off_x = to_x - share * side_x[i], off_y = to_y - share * side_y[i];
      squares[i] = off_x * off_x + off_y * off_y;
    }
  }
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
