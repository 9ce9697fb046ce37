// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/oriented_box.h"

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief A hand with two parallel jaws, or three fingers that close on one axis, as
 * boxes.
 *
 * Hand frame: z is the approach direction, from the palm to the fingertips; y the
 * closing direction of two jaws; x across the fingers. The origin lies midway between
 * the centres of the pads (the tool centre point).
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS Gripper {
  std::string name = "franka_hand";
  int fingers = 2;                 ///< 2: parallel jaws; 3: 120 degrees apart
  double min_opening = 0.0;        ///< smallest width that can be held [m], >= 0
  double max_opening = 0.08;       ///< largest distance of the pads [m]
  double finger_length = 0.0470;   ///< from the palm's face to the fingertip [m]
  double finger_width = 0.0220;    ///< across, along x [m]
  double finger_thickness = 0.026; ///< along the closing direction [m]
  double pad_length = 0.0185;      ///< of the gripping surface, from the tip [m]
  double palm_width = 0.204;       ///< along the closing direction [m]
  double palm_depth = 0.063;       ///< along x [m]
  double palm_height = 0.066;      ///< behind the palm's face [m]

  /** \brief Whether the sizes make a gripper. \param[out] why the first violation as a
   * sentence (optional) */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;

  /** \brief Names that preset() knows. */
  static std::vector<std::string> presetNames();
  /** \brief A hand by name.
   *
   * franka_hand: opening, fingers and palm from the collision boxes of Franka's
   * franka_description; wsg_50: Weiss/Schunk WSG 50-110 with the standard fingers,
   * boxes of the public schunk_wsg_50 model; robotiq_2f_85: stroke and pads as
   * published, its knuckles enclosed in the finger and palm boxes; robotiq_3f: opening
   * as published, the linkage as three boxes. \param[out] gripper untouched for an
   * unknown name \return whether it is known */
  [[nodiscard]] static bool preset(const std::string& name, Gripper& gripper);

  /** \brief The hand's boxes in a pose: one per finger, then the palm.
   * \param[in] position the tool centre point [m] \param[in] rotation the hand frame
   * \param[in] reach distance of each pad's surface from the hand's axis [m], one per
   * finger \param[in] opening how much the outsides of the fingers stand farther out,
   * so that the boxes cover the closing motion [m] \param[in] retreat length of the
   * straight approach that the palm's box covers [m] */
  std::vector<OrientedBox> boxes(const Eigen::Vector3d& position,
                                 const Eigen::Matrix3d& rotation,
                                 const std::vector<double>& reach,
                                 double opening = 0.0,
                                 double retreat = 0.0) const;
  /** \brief Outward direction of a finger in the cloud's frame: the closing direction
   * turned about the approach. */
  Eigen::Vector3d fingerDirection(const Eigen::Matrix3d& rotation, int finger) const;
};

} // namespace pcl_sq
