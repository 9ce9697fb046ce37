// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_sq::detail {

/** \brief A facet of a hull: normal . x + offset <= 0 inside, the normal of unit
 * length.
 */
struct HullFacet {
  Eigen::VectorXd normal;
  double offset = 0.0;
};

/** \brief Convex hull of the columns by Qhull. \param[out] volume of the hull
 * \param[out] corners columns that each facet joins, in no order
 * \return whether the points span the space; else nothing is set */
[[nodiscard]] bool convexHull(const Eigen::MatrixXd& points,
                              std::vector<HullFacet>& facets,
                              double* volume = nullptr,
                              std::vector<std::vector<int>>* corners = nullptr);

} // namespace pcl_sq::detail
