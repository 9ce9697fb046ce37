// SPDX-License-Identifier: BSD-3-Clause
// Private. Numbers, names and meshes as text and bytes of the exported files.
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <string>

namespace pcl_sq::detail {

/** \brief Numbers with nine digits, a point and blanks between, in any locale. */
std::string numbersText(std::initializer_list<double> numbers);
inline std::string numbersText(const Eigen::Vector3d& v) {
  return numbersText({v.x(), v.y(), v.z()});
}
/** \brief Fixed-axis roll, pitch and yaw of a rotation, as URDF and SDF have them. */
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& rotation);
/** \brief A text as XML may hold it. */
std::string escaped(const std::string& text);
/** \brief A mesh as binary STL. */
std::string stlBytes(const TriangleMesh& mesh);

} // namespace pcl_sq::detail
