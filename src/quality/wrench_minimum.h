// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace pcl_sq::detail {

using Wrench = Eigen::Matrix<double, 6, 1>; ///< force, torque over a length

/** \brief The wrenches that one contact can exert at unit normal force. */
struct Cone {
  Eigen::Vector3d n, r;     ///< inward normal; lever from the origin over the length
  double friction, torsion; ///< half axes of the ellipse of tangential force and torque

  /** \brief Wrench of unit normal force with tangential force and torque about n. */
  Wrench wrench(const Eigen::Vector3d& tangential, double torque) const {
    const Eigen::Vector3d force = n + tangential;
    Wrench w;
    w << force, r.cross(force) + torque * n;
    return w;
  }
  /** \brief The wrench of the cone that reaches farthest along d. */
  Wrench farthest(const Wrench& d) const;
};

/** \brief Largest d . w over all cones. */
double support(const std::vector<Cone>& cones, const Wrench& d);

/** \brief Local minimum of the support function on the unit sphere. */
double minimumFrom(const std::vector<Cone>& cones, const Wrench& start);

} // namespace pcl_sq::detail
