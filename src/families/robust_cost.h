// SPDX-License-Identifier: BSD-3-Clause
// Private. The mixture's cost of one residual.
#pragma once

#include <cmath>

namespace pcl_sq::detail {

/** \brief A Gaussian of peak one beside a uniform density c (M5); what kernels::Mixture
 * says for one residual. */
struct RobustCost {
  double sigma, c;

  /** \brief -2 sigma^2 ln of the density over the largest, which is the square itself
   * for c = 0. \param[out] share of the Gaussian in the density */
  double cost(double square, double& share) const {
    share = 1.0;
    if (!(c > 0.0))
      return square;
    const double s = 0.5 / (sigma * sigma);
    const double density = std::exp(-s * square);
    share = density / (density + c);
    return (std::log1p(c) - std::log(density + c)) / s;
  }
};

} // namespace pcl_sq::detail
