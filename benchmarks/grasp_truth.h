// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/triangle_mesh.h"

#include <vector>

/** \brief The true shape of an object, and whether a planned grasp holds on it: found
 * with other means than the planner's. Millions of rays or points are not its purpose.
 */
class GraspTruth {
public:
  /** \param[in] mesh closed or not, in the scene's frame [m] */
  explicit GraspTruth(const pcl_sq::TriangleMesh& mesh);

  /** \brief Closes two jaws from the open position along a ray through the mesh; both
   * normals that they meet must lie in the cones of friction. */
  bool isAntipodal(const pcl_sq::Grasp& grasp, double friction) const;

  /** \brief Whether no box of the hand holds a point of the surface or reaches below
   * the table, at the grasp and along the last \a retreat [m] of the approach. */
  bool isFree(const pcl_sq::Grasp& grasp,
              const pcl_sq::GraspScene& scene,
              const pcl_sq::Gripper& gripper,
              double retreat) const;

private:
  bool castRay(const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction,
               double& distance,
               Eigen::Vector3d& normal) const;

  pcl_sq::TriangleMesh mesh_;
  std::vector<Eigen::Vector3d> samples_; // uniform on the surface
};
