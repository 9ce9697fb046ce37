// SPDX-License-Identifier: BSD-3-Clause
// Private. Distance of a point to a tapered superquadric and its derivatives.
#pragma once

#include "pcl_sq/tapered_superquadric.h"

namespace pcl_sq::detail {

using Vector13 = Eigen::Matrix<double, 13, 1>;

/** \brief Signed distance with its derivatives for t (along the own axes), w, ln a, e1,
 * e2, kx, ky. They are taken at the foot point, as the kernels do: exact on the
 * surface, and up to the curvature times the distance beside it. */
struct TaperRow {
  double residual;
  Vector13 derivatives;
};

TaperRow taperRow(const TaperedSuperquadric& superquadric,
                  const Eigen::Vector3d& point);

/** \brief ln G at a point with its exact derivatives, in the same order. */
TaperRow taperLogGauge(const TaperedSuperquadric& superquadric,
                       const Eigen::Vector3d& point);

} // namespace pcl_sq::detail
