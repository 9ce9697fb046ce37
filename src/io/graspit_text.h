// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <string>

namespace pcl_sq::detail {

constexpr double MILLIMETRES = 1000.0; ///< in a metre

/** \brief A number with nine significant digits and a point, whatever the locale. */
std::string numberText(double number);
/** \brief Three numbers with blanks between. */
std::string vectorText(const Eigen::Vector3d& vector);

/** \brief A mesh in the OFF format, millimetres; no blank line and no comment, on which
 * GraspIt!'s reader stops. */
std::string offText(const TriangleMesh& mesh);

/** \brief One cube, cylinder or sphere per part as an Inventor scene, millimetres: of
 * each the one that shares most of its volume with the part. */
std::string primitivesText(const MultiSuperquadric& model);

} // namespace pcl_sq::detail
