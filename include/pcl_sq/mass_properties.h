// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq {

/** \brief Volume, centre of gravity and inertia of a homogeneous body. */
struct MassProperties {
  double volume = 0.0;                              ///< [m^3]
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< of gravity [m]
  /** \brief About the centre of gravity at density one, axes of the cloud's frame
   * [m^5]; multiply by the density for [kg m^2]. */
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/** \brief Mass properties of a union.
 *
 * Each part enters in closed form; what it shares with the parts before it is
 * integrated over the common bounding box and taken off. Exact where no parts overlap.
 * \param[in] resolution cells along each side of the boxes, [8, 512] */
PCL_SQ_EXPORTS MassProperties massProperties(const MultiSuperquadric& model,
                                             int resolution = 64);

} // namespace pcl_sq
