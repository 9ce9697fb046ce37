// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

namespace pcl_sq {

/** \brief A half-space normal . p <= offset that holds a body and, as a tangent plane,
 * touches it: what a silhouette line or a table says of a body's hidden side. */
struct PCL_SQ_EXPORTS TangentPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length, out of the body
  double offset = 0.0;                               ///< [m]
  double sigma = 1e-3; ///< standard deviation of the offset [m], > 0

  /** \brief normal . center + h(normal) - offset [m] (M6): how far the body sticks out.
   * Zero for a tangent plane. */
  double residual(const Superquadric& body) const {
    return normal.dot(body.center) + body.support(normal) - offset;
  }
  /** \brief Derivatives of residual(), in the order of
   * Superquadric::logGaugeJacobian(). */
  SuperquadricCoefficients jacobian(const Superquadric& body) const {
    return body.supportJacobian(normal);
  }
  /** \brief The same together with residual(), for the price of one of the two.
   * \param[out] residual [m] */
  SuperquadricCoefficients jacobian(const Superquadric& body, double& residual) const {
    double support;
    SuperquadricCoefficients slope = body.supportJacobian(normal, support);
    residual = normal.dot(body.center) + support - offset;
    return slope;
  }
};

} // namespace pcl_sq
