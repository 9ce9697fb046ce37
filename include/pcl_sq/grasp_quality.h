// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp.h"

namespace pcl_sq {

/** \brief How contacts transmit forces. */
struct PCL_SQ_EXPORTS WrenchOptions {
  double friction = 0.5; ///< coefficient mu, [0, 5]
  /** \brief Largest torque about the normal over the normal force [m], >= 0, as
   * softFingerTorsion() gives it; 0 is a point contact. Tangential force and torque
   * share an ellipse (Howe and Cutkosky 1996): |f_t|^2 / mu^2 + torque^2 /
   * torsional_friction^2 <= f_n^2. */
  double torsional_friction = 8.0 / 15.0 * 0.5 * 0.01;
  /** \brief Point about which torques are taken: the centre of gravity [m]. */
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /** \brief Length rho by which torques are divided [m], > 0: the object's largest
   * radius, that is the largest distance of its surface from the centre of gravity, so
   * that epsilon does not depend on the unit (GraspIt! does the same). */
  double torque_length = 0.1;
  int cone_edges = 8; ///< of each cone in the hull (volume, lower bound), [4, 64]

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Quality of a grasp by its wrench space. */
struct WrenchQuality {
  bool force_closure = false;
  /** \brief Radius of the largest ball about the origin in the hull of the wrenches of
   * unit normal force (Ferrari and Canny 1992, L1), cones round; 0 without closure. */
  double epsilon = 0.0;
  double epsilon_lower = 0.0; ///< the same for cones cut into edges, by Qhull
  double volume = 0.0; ///< of the hull of the cones' edges; 0 without force closure
};

/** \brief Largest torque about the normal over the normal force of a soft finger [m]:
 * 8/15 mu a. It grows with the friction as the tangential force does.
 *
 * A layer of rubber presses the more the deeper it is dented, p ~ 1 - (r/a)^2 within a
 * patch of radius a (the "mattress", Johnson 1985, Contact Mechanics, section 4.3).
 * Sliding all round, mu r p integrates to 8/15 mu a times the normal force; GraspIt!
 * takes the same (Ciocarlie, Lackner and Allen 2007, "Soft finger model with adaptive
 * contact geometry for grasping and manipulation tasks").
 * \param[in] friction coefficient mu \param[in] patch_radius a [m] */
inline double softFingerTorsion(double friction, double patch_radius) {
  return 8.0 / 15.0 * friction * patch_radius;
}

/** \brief Largest wrench of the hull along a direction: the support function of the
 * grasp wrench space, in closed form for round cones. \param[in] direction force, then
 * torque over torque_length */
PCL_SQ_EXPORTS double wrenchSupport(const std::vector<GraspContact>& contacts,
                                    const Eigen::Matrix<double, 6, 1>& direction,
                                    const WrenchOptions& options);

/** \brief Epsilon and volume of the grasp wrench space of soft-finger contacts.
 *
 * Cutting the cones into m edges makes epsilon up to 1 - cos(pi/m) too small. Here the
 * nearest facets of the hull of the cut cones (Qhull) are only starts: from each, the
 * support function of the round cones is minimised over the unit sphere by a bundle
 * method.
 * \param[in] contacts with outward normals; fewer than two never close */
PCL_SQ_EXPORTS WrenchQuality wrenchQuality(const std::vector<GraspContact>& contacts,
                                           const WrenchOptions& options);

} // namespace pcl_sq
