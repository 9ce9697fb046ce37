// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

namespace pcl_sq {

/** \brief A measured point on the surface of a model with what a hand needs to know. */
struct EIGEN_ALIGN16 PointGrasp {
  PCL_ADD_POINT4D            ///< the measured point [m]
      PCL_ADD_NORMAL4D       ///< outward normal of the superquadric, of unit length
      float residual = 0.0f; ///< signed first-order distance to its surface [m]
  std::uint32_t part = 0;    ///< index of the part it lies on
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

/** \brief The part nearest to a point, its normal and the point's distance.
 * \pre \a model is not empty */
PCL_SQ_EXPORTS PointGrasp describeGraspPoint(const MultiSuperquadric& model,
                                             const Eigen::Vector3d& point);

} // namespace pcl_sq

POINT_CLOUD_REGISTER_POINT_STRUCT(
    pcl_sq::PointGrasp,
    (float, x, x)(float, y, y)(float, z, z)(float, normal_x, normal_x)(
        float, normal_y, normal_y)(float, normal_z, normal_z)(
        float, residual, residual)(std::uint32_t, part, part))
