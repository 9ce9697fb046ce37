// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kernels/kernels.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::detail {

/** \brief ln of the nested p-norm G (M1) and everything its derivatives need.
 *
 * With X = |x|/a1 etc., the inner norm h = ||(X, Y)||_{2/e2} and the outer norm
 * G = ||(h, Z)||_{2/e1}, the weights are the shares of each term in its sum:
 * d ln h / d ln X = inner_x, d ln G / d ln h = outer_h and so on. */
struct LogGauge {
  double value;            ///< ln G
  double inner_x, inner_y; ///< shares of X and Y in the inner norm, sum 1
  double outer_h, outer_z; ///< shares of h and Z in the outer norm, sum 1
  double inner_entropy;    ///< 2 d ln h / d e2
  double outer_entropy;    ///< 2 (d ln G / d e1), h held
};

/** \brief Smallest argument of a logarithm: anything nearer to an axis is on it. */
constexpr double TINY = 1e-300;

/** \brief ln of ||(exp(l0), exp(l1))||_{2/epsilon} with the two shares and the entropy.
 */
inline double
logNorm(double l0, double l1, double epsilon, double& w0, double& w1, double& entropy) {
  const double q = 2.0 / epsilon;
  const double larger = std::max(l0, l1);
  const double difference = std::min(l0, l1) - larger;
  const double u = std::exp(q * difference);
  const double w_larger = 1.0 / (1.0 + u);
  const double w_smaller = u * w_larger;
  w0 = l0 >= l1 ? w_larger : w_smaller;
  w1 = l0 >= l1 ? w_smaller : w_larger;
  const double log_sum = std::log1p(u);
  entropy = u > 0.0 ? log_sum - q * difference * w_smaller : 0.0;
  return larger + log_sum / q;
}

/** \brief ln G of a point in the superquadric's own frame, Eq. (3). */
inline LogGauge logGauge(const Eigen::Vector3d& local,
                         const Eigen::Vector3d& semi_axes,
                         double epsilon1,
                         double epsilon2) {
  LogGauge g;
  const double lx = std::log(std::max(std::abs(local.x()) / semi_axes.x(), TINY));
  const double ly = std::log(std::max(std::abs(local.y()) / semi_axes.y(), TINY));
  const double lz = std::log(std::max(std::abs(local.z()) / semi_axes.z(), TINY));
  const double lh = logNorm(lx, ly, epsilon2, g.inner_x, g.inner_y, g.inner_entropy);
  g.value = logNorm(lh, lz, epsilon1, g.outer_h, g.outer_z, g.outer_entropy);
  return g;
}

/** \brief share / coordinate, the gradient of ln G along one axis; 0 on the axis plane.
 */
inline double shareOver(double share, double coordinate) {
  const double r = share / coordinate;
  return std::isfinite(r) ? r : 0.0;
}

/** \brief Gradient of ln G in the superquadric's own frame. */
inline Eigen::Vector3d logGaugeGradient(const LogGauge& g,
                                        const Eigen::Vector3d& local) {
  return {shareOver(g.outer_h * g.inner_x, local.x()),
          shareOver(g.outer_h * g.inner_y, local.y()),
          shareOver(g.outer_z, local.z())};
}

/** \brief Where the surface is met along one of the axes. */
struct AlongAxis {
  Eigen::Vector3d at;
  double away; ///< from the point; infinite where no axis meets it
};

/** \brief The nearest of these places of a straight body (M4).
 * \param[in] stretch how much longer the body is along each axis, for it is tapered */
inline AlongAxis nearestAlongAxes(const Eigen::Vector3d& straight,
                                  const Eigen::Vector3d& semi_axes,
                                  double epsilon1,
                                  double epsilon2,
                                  const Eigen::Vector3d& stretch) {
  const Eigen::Array3d over = straight.cwiseAbs().cwiseQuotient(semi_axes).array();
  const double q1 = 2.0 / epsilon1, q2 = 2.0 / epsilon2;
  const double x = std::pow(over.x(), q2), y = std::pow(over.y(), q2);
  const double z = std::pow(over.z(), q1);
  const double section = std::pow(x + y, q1 / q2);                // of x and y in F
  const double left = z < 1.0 ? std::pow(1.0 - z, q2 / q1) : 0.0; // for x and y there
  // of each axis: its term in F where the surface is met along it
  const double terms[] = {left - y, left - x, 1.0 - section};
  const double powers[] = {1.0 / q2, 1.0 / q2, 1.0 / q1};
  AlongAxis near{straight, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    if (!(terms[k] > 0.0))
      continue;
    const double height = semi_axes[k] * std::pow(terms[k], powers[k]);
    const double away = std::abs(height - std::abs(straight[k])) * stretch[k];
    if (away < near.away) {
      near = {straight, away};
      near.at[k] = std::copysign(height, straight[k]);
    }
  }
  return near;
}

/** \brief Whether feet are looked for along the axes too. */
inline bool isFlat(const Eigen::Vector3d& semi_axes) {
  return semi_axes.maxCoeff() > double(kernels::FLAT) * semi_axes.minCoeff();
}

} // namespace pcl_sq::detail
