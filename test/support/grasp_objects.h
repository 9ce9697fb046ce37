// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"

#include "random_superquadric.h"

namespace pcl_sq::test {

inline Superquadric
part(const Eigen::Vector3d& axes, double e1, double e2, const Eigen::Vector3d& center) {
  Superquadric s;
  s.semi_axes = axes;
  s.epsilon1 = e1;
  s.epsilon2 = e2;
  s.center = center;
  return s;
}

/** \brief A cup of 7 cm with a handle, standing on z = 0. */
inline MultiSuperquadric cup() {
  MultiSuperquadric cup;
  cup.parts = {part({0.035, 0.035, 0.05}, 0.15, 1.0, {0.0, 0.0, 0.05}),
               part({0.006, 0.006, 0.028}, 0.3, 0.5, {0.060, 0.0, 0.05}),
               part({0.016, 0.006, 0.006}, 0.5, 0.3, {0.049, 0.0, 0.075}),
               part({0.016, 0.006, 0.006}, 0.5, 0.3, {0.049, 0.0, 0.025})};
  return cup;
}

/** \brief A bottle with a neck, standing on z = 0. Not bottle(), which is another one's
 * name: two inline functions of one name are one in a program, whichever comes first.
 */
inline MultiSuperquadric standingBottle() {
  MultiSuperquadric bottle;
  bottle.parts = {part({0.033, 0.033, 0.1}, 0.2, 1.0, {0.0, 0.0, 0.1}),
                  part({0.013, 0.013, 0.04}, 0.2, 1.0, {0.0, 0.0, 0.23})};
  return bottle;
}

inline GraspScene onTable() {
  GraspScene scene;
  scene.has_table = true;
  scene.has_viewpoint = true;
  scene.viewpoint = {0.0, -0.8, 0.5};
  return scene;
}

inline std::vector<double> reach(const Gripper& gripper, const Grasp& grasp) {
  std::vector<double> all;
  for (int i = 0; i < gripper.fingers; ++i)
    all.push_back(gripper.fingerDirection(grasp.rotation, i)
                      .dot(grasp.contacts[std::size_t(i)].position - grasp.position));
  return all;
}

} // namespace pcl_sq::test
