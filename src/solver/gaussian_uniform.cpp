// SPDX-License-Identifier: BSD-3-Clause
#include "solver/gaussian_uniform.h"

#include "solver/surface_area.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double SQRT_TWO_PI = 2.5066282746310002;
constexpr double FOUR_PI = 12.566370614359172; ///< the Gaussian curvature of any body
constexpr double MIN_OUTLIER_SHARE = 1e-3; ///< so that a point can always become one

} // namespace

double Mixture::filledArea(double area) const {
  return area + FOUR_PI * sigma * sigma;
}

double Mixture::outlier(double area) const {
  return outlier_share / (1.0 - outlier_share) * filledArea(area) / volume *
         SQRT_TWO_PI * sigma;
}

double
Mixture::negativeLogLikelihood(double cost, std::size_t count, double area) const {
  const double peak = (1.0 - outlier_share) / (filledArea(area) * SQRT_TWO_PI * sigma);
  return 0.5 * cost / (sigma * sigma * double(count)) -
         std::log(peak * (1.0 + outlier(area)));
}

Mixture estimated(const Mixture& before,
                  double share,
                  double weighted,
                  std::size_t count,
                  const MixtureLimits& limits) {
  Mixture m = before;
  if (limits.fixed_sigma > 0.0)
    m.sigma = limits.fixed_sigma;
  else if (share > 0.0)
    m.sigma = std::max(std::sqrt(weighted / share), limits.min_sigma);
  m.outlier_share =
      limits.robust ? std::clamp(1.0 - share / double(count),
                                 MIN_OUTLIER_SHARE,
                                 std::max(limits.max_outlier_share, MIN_OUTLIER_SHARE))
                    : 0.0;
  return m;
}

double surfaceArea(const Superquadric& m) {
  return std::exp(logArea(m.semi_axes, m.epsilon1, m.epsilon2).value);
}

Contributor sizePrior(double sigma, double inliers) {
  const double weight = 0.5 * sigma * sigma * inliers;
  Mixture mixture;
  mixture.sigma = sigma;
  return [weight, mixture](const Superquadric& m, NormalEquations& e) {
    const LogArea own = logArea(m.semi_axes, m.epsilon1, m.epsilon2);
    const double area = std::exp(own.value), filled = mixture.filledArea(area);
    const Eigen::Matrix<double, 5, 1> gradient = area / filled * own.gradient;
    e.cost += 2.0 * weight * std::log(filled);
    e.jtr.tail<5>() += weight * gradient;
    // curvature of a quadratic that is flat by one unit of ln A: keeps steps finite
    // where the points say nothing
    e.jtj.bottomRightCorner<5, 5>() += weight * gradient * gradient.transpose();
  };
}

} // namespace pcl_sq::detail
