// SPDX-License-Identifier: BSD-3-Clause
// Private. What the least squares of all families do alike: points as robust rows,
// steps within a trust region, bounds, held directions.
#pragma once

#include "geometry/taper.h"
#include "tuning/view_tuning.h"
#include "view_problem/view_problem.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace pcl_sq::detail {

/** \brief A Gaussian of peak one beside a uniform density c (M5); what kernels::Mixture
 * says for one residual. */
class RobustCost {
public:
  RobustCost(double sigma, double c)
      : c_(c), s_(0.5 / (sigma * sigma)), log_full_(std::log1p(c)) {}

  /** \brief -2 sigma^2 ln of the density over the largest, which is the square itself
   * for c = 0. \param[out] share of the Gaussian in the density */
  double cost(double square, double& share) const {
    share = 1.0;
    if (!(c_ > 0.0))
      return square;
    const double density = std::exp(-s_ * square);
    share = density / (density + c_);
    return (log_full_ - std::log(density + c_)) / s_;
  }

private:
  double c_, s_, log_full_;
};

/** \brief Cost of the points alone, in units of sigma^2. */
inline double
pointsCost(const UnitPoints& points, double sigma, const Superquadric& body) {
  std::vector<float> distances(points.size() + kernels::BLOCK);
  residualsOf(body, points, kernels::Residual::FOOT_POINT, distances.data());
  const RobustCost density{sigma, tuning::shared::OUTLIER};
  double cost = 0.0, share;
  for (std::size_t i = 0; i < points.size(); ++i)
    cost += density.cost(double(distances[i]) * double(distances[i]), share);
  return cost / (sigma * sigma);
}

/** \brief Parameters that belong together, and the largest step of any of them. */
struct TrustRegion {
  int begin, size;
  double largest;
};

/** \brief Shortens a step to its trust regions. \return whether any of them did */
template <class Vector>
bool shorten(std::initializer_list<TrustRegion> regions, Vector& step) {
  bool limited = false;
  for (const TrustRegion& region : regions) {
    auto part = step.segment(region.begin, region.size);
    const double largest = part.cwiseAbs().maxCoeff();
    if (!(largest > region.largest))
      continue;
    part *= region.largest / largest;
    limited = true;
  }
  return limited;
}

/** \brief Moves a body along its own axes and turns it about them. */
inline void moveRigidly(const Eigen::Vector3d& along,
                        const Eigen::Vector3d& turn,
                        Superquadric& s) {
  s.center += s.rotation * along;
  if (turn.norm() > 0.0)
    s.rotation *= Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

/** \brief Whether a value at its bound would leave it. */
inline bool leaves(double value, double low, double high, double direction) {
  return (value <= low && direction < 0.0) || (value >= high && direction > 0.0);
}

/** \brief All directions but those of some parameters. */
template <int N>
Basis<N> basisWithout(std::initializer_list<int> held) {
  Basis<N> basis = Basis<N>::Zero(N, N - int(held.size()));
  int columns = 0;
  for (int k = 0; k < N; ++k)
    if (std::find(held.begin(), held.end(), k) == held.end())
      basis(k, columns++) = 1.0;
  return basis;
}

} // namespace pcl_sq::detail
