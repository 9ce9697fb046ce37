// SPDX-License-Identifier: BSD-3-Clause
#include "taper_line.h"

#include "pcl_sq/line_intersection.h"

#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int SAMPLES = 12;     ///< the gauge may have several minima along a line
constexpr int REFINEMENTS = 20; ///< golden sections around the best of them
constexpr double GOLDEN = 0.6180339887498949;

} // namespace

double smallestGauge(const TaperedSuperquadric& s,
                     const Eigen::Vector3d& origin,
                     const Eigen::Vector3d& direction,
                     double& at) {
  Superquadric box = s.shape; // holds the tapered body
  box.semi_axes.x() *= 1.0 + std::abs(s.kx);
  box.semi_axes.y() *= 1.0 + std::abs(s.ky);
  LineInterval chord;
  if (!intersectLineBox(box, origin, direction, chord))
    return std::numeric_limits<double>::infinity();
  const auto gauge = [&](double t) { return s.gauge(origin + t * direction); };
  const double step = (chord.leave - chord.enter) / SAMPLES;
  double best = chord.enter, least = gauge(best);
  for (int i = 1; i <= SAMPLES; ++i) {
    const double t = chord.enter + i * step, value = gauge(t);
    if (value < least) {
      least = value;
      best = t;
    }
  }
  double low = best - step, high = best + step;
  double left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
  double at_left = gauge(left), at_right = gauge(right);
  for (int i = 0; i < REFINEMENTS; ++i)
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - GOLDEN * (high - low);
      at_left = gauge(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + GOLDEN * (high - low);
      at_right = gauge(right);
    }
  at = at_left < at_right ? left : right;
  return std::min(at_left, at_right);
}

} // namespace pcl_sq::detail
