// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/gripper.h"

#include <utility>

namespace pcl_sq {

namespace {

std::vector<Gripper> presets() {
  Gripper wsg;
  wsg.name = "wsg_50";
  wsg.max_opening = 0.110;
  wsg.finger_length = 0.0819;
  wsg.finger_width = 0.020;
  wsg.finger_thickness = 0.012;
  wsg.pad_length = 0.022;
  wsg.palm_width = 0.146;
  wsg.palm_depth = 0.050;
  wsg.palm_height = 0.0725;
  Gripper robotiq;
  robotiq.name = "robotiq_2f_85";
  robotiq.max_opening = 0.085;
  robotiq.finger_length = 0.060;
  robotiq.finger_width = 0.027;
  robotiq.finger_thickness = 0.020;
  robotiq.pad_length = 0.0375;
  robotiq.palm_width = 0.149;
  robotiq.palm_depth = 0.075;
  robotiq.palm_height = 0.095;
  Gripper three;
  three.name = "robotiq_3f";
  three.fingers = 3;
  three.min_opening = 0.02;
  three.max_opening = 0.155;
  three.finger_length = 0.100;
  three.finger_width = 0.020;
  three.finger_thickness = 0.020;
  three.pad_length = 0.030;
  three.palm_width = 0.126;
  three.palm_depth = 0.126;
  three.palm_height = 0.126;
  return {Gripper(), robotiq, wsg, three};
}

} // namespace

bool Gripper::isValid(std::string* why) const {
  const auto fail = [why](const std::string& sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  if (fingers != 2 && fingers != 3)
    return fail("a gripper has two or three fingers");
  const std::pair<const char*, double> sizes[] = {
      {"max_opening", max_opening},
      {"finger_length", finger_length},
      {"finger_width", finger_width},
      {"finger_thickness", finger_thickness},
      {"pad_length", pad_length},
      {"palm_width", palm_width},
      {"palm_depth", palm_depth},
      {"palm_height", palm_height}};
  for (const auto& [key, size] : sizes)
    if (!(size >= 1e-4 && size <= 2.0))
      return fail(std::string(key) + " is not between 0.1 mm and 2 m");
  if (!(min_opening >= 0.0) || min_opening >= max_opening)
    return fail("min_opening is not between 0 and max_opening");
  if (pad_length > finger_length)
    return fail("the pad is longer than the finger");
  return true;
}

std::vector<std::string> Gripper::presetNames() {
  std::vector<std::string> names;
  for (const Gripper& gripper : presets())
    names.push_back(gripper.name);
  return names;
}

bool Gripper::preset(const std::string& name, Gripper& gripper) {
  for (const Gripper& candidate : presets())
    if (candidate.name == name) {
      gripper = candidate;
      return true;
    }
  return false;
}

namespace {

/** \brief Turn about the approach from the first finger to another: two fingers face
 * each other, three stand 120 degrees apart. */
Eigen::Matrix3d fingerTurn(int fingers, int finger) {
  const double cosine = finger == 0 ? 1.0 : fingers == 2 ? -1.0 : -0.5;
  const double sine = finger == 0 || fingers == 2 ? 0.0
                      : finger == 1               ? 0.5 * std::sqrt(3.0)
                                                  : -0.5 * std::sqrt(3.0);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  return turn;
}

} // namespace

Eigen::Vector3d Gripper::fingerDirection(const Eigen::Matrix3d& rotation,
                                         int finger) const {
  return rotation * fingerTurn(fingers, finger).col(1);
}

std::vector<OrientedBox> Gripper::boxes(const Eigen::Vector3d& position,
                                        const Eigen::Matrix3d& rotation,
                                        const std::vector<double>& reach,
                                        double opening,
                                        double retreat) const {
  const double tip = 0.5 * pad_length, palm = tip - finger_length;
  std::vector<OrientedBox> all(std::size_t(fingers) + 1);
  for (int i = 0; i < fingers; ++i) {
    OrientedBox& finger = all[std::size_t(i)];
    finger.rotation = rotation * fingerTurn(fingers, i);
    finger.half_sizes =
        0.5 * Eigen::Vector3d(finger_width, finger_thickness + opening, finger_length);
    const double outwards = reach[std::size_t(i)] + finger.half_sizes.y();
    finger.center =
        position + finger.rotation * Eigen::Vector3d(0.0, outwards, 0.5 * (tip + palm));
  }
  OrientedBox& hand = all.back();
  hand.rotation = rotation;
  hand.half_sizes =
      0.5 * Eigen::Vector3d(palm_depth, palm_width, palm_height + retreat);
  hand.center = position + rotation.col(2) * (palm - hand.half_sizes.z());
  return all;
}

} // namespace pcl_sq
