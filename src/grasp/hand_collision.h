// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"
#include "util/point_grid.h"

namespace pcl_sq::detail {

/** \brief What a hand can run into. */
enum class Obstruction { NONE, TABLE, OBJECT, OBSTACLE, CLOUD };

/** \brief The scene prepared for many hand poses. */
class HandCollision {
public:
  HandCollision(const MultiSuperquadric& object,
                const GraspScene& scene,
                const Gripper& gripper,
                const GraspPlannerOptions& options);

  /** \brief The hand's boxes of a grasp while it approaches, closes from \a opening on
   * each side and holds: fingers, then the palm. */
  std::vector<OrientedBox> boxes(const Grasp& grasp, double opening) const;
  /** \brief Least distance of the boxes to the table's plane [m], 1 m without one. */
  double tableClearance(const std::vector<OrientedBox>& boxes) const;
  /** \brief First thing a box runs into but for the table. \param[in] margin least
   * distance to the object [m] */
  Obstruction test(const OrientedBox& box, double margin) const;

  /** \brief Share of a contact that the sensor saw, GraspContact::observed.
   * \param[in] at_rim the wall is thin there: who saw one side knows the other */
  double observed(const GraspContact& contact, bool at_rim = false) const;

private:
  void sortCloud(const GraspScene& scene);

  const MultiSuperquadric& object_;
  const GraspScene& scene_;
  const Gripper& gripper_;
  const GraspPlannerOptions& options_;
  PointGrid seen_;      ///< measured points of the object
  PointGrid obstacles_; ///< measured points of anything else but the table
};

} // namespace pcl_sq::detail
