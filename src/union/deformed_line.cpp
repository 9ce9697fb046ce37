// SPDX-License-Identifier: BSD-3-Clause
#include "union/deformed_line.h"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

int samplesAlong(const Superquadric& s) {
  constexpr double AT_LEAST = 12.0, AT_MOST = 96.0;
  if (!s.isBent())
    return int(AT_LEAST);
  const double rod = s.semi_axes.minCoeff();
  return int(std::clamp(2.0 * s.halfSizes().norm() / rod, AT_LEAST, AT_MOST));
}

double deepest(const Superquadric& s,
               const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction,
               const LineInterval& range,
               double& gauge) {
  constexpr int PRECISION_BITS = 26;
  const int samples = samplesAlong(s);
  const auto at = [&](double t) { return s.gauge(origin + t * direction); };
  const double step = (range.leave - range.enter) / samples;
  double best = range.enter;
  gauge = at(best);
  for (int i = 1; i <= samples; ++i) {
    const double t = range.enter + i * step, value = at(t);
    if (value < gauge) {
      gauge = value;
      best = t;
    }
  }
  if (gauge <= 1.0) // an inside place is all that is wanted
    return best;
  const auto refined = boost::math::tools::brent_find_minima(
      at, best - step, best + step, PRECISION_BITS);
  if (refined.second < gauge) {
    gauge = refined.second;
    best = refined.first;
  }
  return best;
}

double crossing(const Superquadric& s,
                const Eigen::Vector3d& origin,
                const Eigen::Vector3d& direction,
                double inside,
                double outside) {
  if (s.isBent()) {
    const int samples = samplesAlong(s);
    const double end = outside, step = (end - inside) / samples;
    for (int i = 1; i <= samples; ++i) {
      outside = i < samples ? inside + step : end;
      if (s.gauge(origin + outside * direction) > 1.0)
        break;
      inside = outside;
    }
  }
  const auto beyond = [&](double t) { return s.gauge(origin + t * direction) - 1.0; };
  const double first = beyond(inside), last = beyond(outside);
  if (!(first < 0.0 && last > 0.0)) // grazed, or the box touches
    return last > 0.0 ? inside : outside;
  std::uintmax_t most = 60;
  const auto [low, high] =
      boost::math::tools::toms748_solve(beyond,
                                        std::min(inside, outside),
                                        std::max(inside, outside),
                                        inside < outside ? first : last,
                                        inside < outside ? last : first,
                                        boost::math::tools::eps_tolerance<double>(),
                                        most);
  return inside < outside ? low : high;
}

} // namespace pcl_sq::detail
