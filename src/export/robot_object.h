// SPDX-License-Identifier: BSD-3-Clause
// Private. What all robots' formats say of an object.
#pragma once

#include "export/collision_shapes.h"

#include "pcl_sq/mass_properties.h"
#include "pcl_sq/robot_export.h"

namespace pcl_sq::detail {

/** \brief An object with its place, mass and shapes. */
struct RobotObject {
  std::string frame; ///< of the cloud, "world" without a name
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< centre of gravity [m]
  double mass = 0.0;                                 ///< [kg]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< about it [kg m^2]
  std::vector<CollisionShape> shapes;
  std::vector<TextFile> meshes; ///< of the visual and of each shape that is a mesh

  /** \brief A shape's centre in the object's frame. */
  Eigen::Vector3d placeOf(const CollisionShape& shape) const {
    return shape.center - origin;
  }
};

/** \brief Name of a mesh's file: 0 is the visual one, i + 1 that of shape i. */
std::string meshName(const RobotExportOptions& options, std::size_t number);

/** \brief Collects it. \return false for an empty model or options out of range */
[[nodiscard]] bool robotObject(const ModelFile& file,
                               const RobotExportOptions& options,
                               RobotObject& object);

} // namespace pcl_sq::detail
