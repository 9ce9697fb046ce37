// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/gripper.h"

namespace pcl_sq {

/** \brief Where a finger touches the object. */
struct GraspContact {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< [m], in the cloud's frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, of unit length
  std::size_t part = 0;                               ///< index of the part touched
  /** \brief How much the sensor saw of it, [0, 1]: 1 beside a point of the cloud, 0 on
   * the far side; 1 where neither cloud nor viewpoint are known. */
  double observed = 1.0;
};

/** \brief The terms a grasp is ranked by, each in [0, 1], 1 the best. */
struct GraspScores {
  /** \brief 1 - tan(angle between normal and closing line) / friction, of the worse
   * contact. */
  double antipodal = 0.0;
  /** \brief Share of parallel lines beside the closing line that still find surface
   * within the friction cone: what remains of the grasp if the model is a little off.
   */
  double robustness = 0.0;
  double observed = 0.0;  ///< mean of the contacts' observed shares
  double centre = 0.0;    ///< closeness of the closing line to the centre of gravity
  double clearance = 0.0; ///< distance of the hand to the table over 3 cm
  double approach = 0.0;  ///< from above and from the viewer's side rather than behind
  double opening = 0.0;   ///< room left between the open jaws and the object
  double total = 0.0;     ///< weighted mean of the terms above
};

/** \brief A pose of the hand with the contacts it makes.
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS Grasp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< tool centre point [m]
  /** \brief The hand frame (see Gripper): columns x across the fingers, y closing
   * direction, z approach direction. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  std::vector<GraspContact> contacts; ///< one per finger
  double width = 0.0; ///< distance of the pads when closed [m]; of three fingers twice
                      ///< the largest distance of a contact from the hand's axis
  double open_width = 0.0; ///< the same while the hand approaches [m]
  GraspScores scores;
  double epsilon = 0.0; ///< Ferrari-Canny; 0 unless the planner was asked for it
  double volume = 0.0;  ///< of the grasp wrench space; 0 unless asked for

  /** \brief Direction in which the hand moves towards the object. */
  Eigen::Vector3d approach() const { return rotation.col(2); }
  /** \brief Direction of the line between two jaws. */
  Eigen::Vector3d closing() const { return rotation.col(1); }
};

} // namespace pcl_sq
