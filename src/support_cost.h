// SPDX-License-Identifier: BSD-3-Clause
// Private. The cost of tangent planes and half-spaces beside that of the points.
#pragma once

#include "levenberg_marquardt.h"
#include "pcl_sq/support_plane.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Squared, weighted support residuals, in the frame of the points.
 *
 * The silhouette's lines share an unknown dilation b ~ N(0, dilation_sigma^2), which is
 * integrated out: sum z^2 - (sum z u)^2 / (sum u^2 + 1 / dilation_sigma^2), with z the
 * residuals over their sigmas and u the inverse sigmas; the Gauss-Newton matrix loses
 * the same term of rank one. */
struct SupportCost {
  std::vector<SupportPlane> silhouette; ///< tangents with a common dilation
  std::vector<SupportPlane> tangents;   ///< planes that the body touches
  std::vector<SupportPlane> limits;     ///< half-spaces that hold the body
  double dilation_sigma = 0.0;          ///< 0: the silhouette is exact
  /** \brief What a residual of one sigma costs, as a length: makes the costs of planes
   * and points comparable. */
  double unit = 1.0;

  bool empty() const {
    return silhouette.empty() && tangents.empty() && limits.empty();
  }
  /** \brief Adds cost and derivatives. */
  void operator()(const Superquadric& body, NormalEquations& equations) const;
};

} // namespace pcl_sq::detail
