// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grasp/measured_surface.h"

namespace pcl_sq::detail {

/** \brief What a hand can run into. */
enum class Obstruction { NONE, TABLE, OBJECT, OBSTACLE, CLOUD };

/** \brief The scene prepared for many hand poses. */
class HandCollision {
public:
  HandCollision(const MultiSuperquadric& object,
                const GraspScene& scene,
                const Gripper& gripper,
                const GraspPlannerOptions& options,
                const MeasuredSurface& measured);

  /** \brief The hand's boxes of a grasp while it approaches, closes from \a opening on
   * each side and holds: fingers, then the palm. */
  std::vector<OrientedBox> boxes(const Grasp& grasp, double opening) const;
  /** \brief Least distance of the boxes to the table's plane [m], 1 m without one. */
  double tableClearance(const std::vector<OrientedBox>& boxes) const;
  /** \brief First thing a box runs into but for the table. \param[in] margin least
   * distance to the object [m] */
  Obstruction test(const OrientedBox& box, double margin) const;

private:
  const MultiSuperquadric& object_;
  const GraspScene& scene_;
  const Gripper& gripper_;
  const GraspPlannerOptions& options_;
  PointGrid obstacles_; ///< measured points of anything else but the table
};

} // namespace pcl_sq::detail
