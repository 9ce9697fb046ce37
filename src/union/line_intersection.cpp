// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/line_intersection.h"

#include "geometry/gauge.h"
#include "union/deformed_line.h"

#include <limits>

namespace pcl_sq {

namespace {

constexpr int NEWTON_STEPS = 80;     ///< a tangential line converges linearly
constexpr double ON_SURFACE = 1e-12; ///< G - 1 that counts as on the surface

/** \brief The line in axes in which the superquadric's box is the unit cube. */
struct UnitLine {
  Eigen::Vector3d origin, direction;
};

UnitLine toUnitCube(const Superquadric& s,
                    const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction) {
  const Eigen::Vector3d scale = s.halfSizes().cwiseInverse();
  return {s.toLocal(origin).cwiseProduct(scale),
          (s.rotation.transpose() * direction).cwiseProduct(scale)};
}

bool clipToUnitCube(const UnitLine& line, LineInterval& interval) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(line.direction[k]) < 1e-300) {
      if (std::abs(line.origin[k]) > 1.0)
        return false;
      continue;
    }
    const double a = (-1.0 - line.origin[k]) / line.direction[k];
    const double b = (1.0 - line.origin[k]) / line.direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter <= leave) || !std::isfinite(enter) || !std::isfinite(leave))
    return false;
  interval = {enter, leave};
  return true;
}

/** \brief Newton from outside towards the surface; \a sign is +1 for the entry.
 * \return whether the surface was reached before \a limit */
bool approach(const Superquadric& s,
              const UnitLine& line,
              double sign,
              double limit,
              double& at) {
  const Eigen::Vector3d unit = Eigen::Vector3d::Ones();
  for (int step = 0; step < NEWTON_STEPS; ++step) {
    const Eigen::Vector3d p = line.origin + at * line.direction;
    const detail::LogGauge g = detail::logGauge(p, unit, s.epsilon1, s.epsilon2);
    const double value = std::exp(g.value);
    if (value - 1.0 <= ON_SURFACE)
      return true;
    const double slope =
        value * detail::logGaugeGradient(g, p).dot(line.direction) * sign;
    if (!(slope < 0.0))
      return false; // past the lowest point without having been inside
    const double step_length = (value - 1.0) / -slope;
    at += sign * step_length;
    if (sign * (at - limit) > 0.0)
      return false;
  }
  return true;
}

} // namespace

bool intersectLineBox(const Superquadric& s,
                      const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction,
                      LineInterval& interval) {
  return clipToUnitCube(toUnitCube(s, origin, direction), interval);
}

namespace {

bool intersectWhole(const Superquadric& s,
                    const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction,
                    LineInterval& interval) {
  const UnitLine line = toUnitCube(s, origin, direction);
  LineInterval box;
  if (!clipToUnitCube(line, box))
    return false;
  if (s.isDeformed()) {
    double gauge;
    const double inside = detail::deepest(s, origin, direction, box, gauge);
    if (!(gauge <= 1.0))
      return false;
    interval.enter = detail::crossing(s, origin, direction, inside, box.enter);
    interval.leave = detail::crossing(s, origin, direction, inside, box.leave);
    return true;
  }
  LineInterval found = box;
  if (!approach(s, line, 1.0, box.leave, found.enter) ||
      !approach(s, line, -1.0, found.enter, found.leave))
    return false;
  interval = found;
  return true;
}

/** \brief The body that reaches on beyond the rim, filled. */
Superquadric wholeOf(const Superquadric& s) {
  Superquadric whole = s;
  whole.rim = 1.0;
  whole.wall = 0.0;
  return whole;
}

/** \brief Leaves what of an interval lies below the rim. \return whether anything does
 */
bool clipAtRim(const Superquadric& s,
               const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction,
               LineInterval& interval) {
  const Eigen::Vector3d axis = s.rotation.col(2);
  const double above = axis.dot(origin - s.center) - s.rimHeight() * s.semi_axes.z();
  const double rise = axis.dot(direction);
  if (rise == 0.0)
    return above <= 0.0;
  const double crossing = -above / rise;
  if (rise > 0.0)
    interval.leave = std::min(interval.leave, crossing);
  else
    interval.enter = std::max(interval.enter, crossing);
  return interval.enter <= interval.leave;
}

} // namespace

bool intersectLine(const Superquadric& s,
                   const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction,
                   LineInterval& interval) {
  if (!s.isCut())
    return intersectWhole(s, origin, direction, interval);
  LineInterval found;
  if (!intersectWhole(wholeOf(s), origin, direction, found) ||
      !clipAtRim(s, origin, direction, found))
    return false;
  interval = found;
  return true;
}

bool meetsRay(const Superquadric& s,
              const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction) {
  LineInterval range;
  if (!intersectLineBox(s, origin, direction, range) ||
      (s.isCut() && !clipAtRim(s, origin, direction, range)) || range.leave < 0.0)
    return false;
  range.enter = std::max(range.enter, 0.0);
  const Superquadric whole = wholeOf(s);
  if (s.isDeformed()) {
    // most rays that meet it do so in the middle
    const double middle = 0.5 * (range.enter + range.leave);
    if (whole.gauge(origin + middle * direction) <= 1.0)
      return true;
    double gauge;
    detail::deepest(whole, origin, direction, range, gauge);
    return gauge <= 1.0;
  }
  return approach(
      whole, toUnitCube(whole, origin, direction), 1.0, range.leave, range.enter);
}

namespace {

/** \brief The first of the places where a ray enters a bent body. */
bool firstHitOfBent(const Superquadric& s,
                    const Eigen::Vector3d& origin,
                    const Eigen::Vector3d& direction,
                    double& at) {
  LineInterval box;
  if (!intersectLineBox(s, origin, direction, box) || box.leave < 0.0)
    return false;
  const int samples = detail::samplesAlong(s);
  const double step = (box.leave - std::max(box.enter, 0.0)) / samples;
  double outside = std::max(box.enter, 0.0);
  for (int i = 0; i <= samples; ++i) {
    const double t = std::max(box.enter, 0.0) + i * step;
    if (s.gauge(origin + t * direction) <= 1.0) {
      at = i > 0 ? detail::crossing(s, origin, direction, t, outside) : t;
      return true;
    }
    outside = t;
  }
  LineInterval grazing; // thinner than a step
  if (!intersectLine(s, origin, direction, grazing) || grazing.enter < 0.0)
    return false;
  at = grazing.enter;
  return true;
}

} // namespace

bool firstHit(const Superquadric& s,
              const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction,
              double& at) {
  if (s.isBent())
    return firstHitOfBent(s, origin, direction, at);
  LineInterval filled;
  if (!intersectLine(s, origin, direction, filled) || filled.leave < 0.0)
    return false;
  const double enter = std::max(filled.enter, 0.0);
  if (!s.isHollow()) {
    at = enter;
    return true;
  }
  // through the opening: the hollow is left where the line meets the inside
  constexpr int SAMPLES = 64;
  constexpr int BISECTIONS = 52;
  const double step = (filled.leave - enter) / SAMPLES;
  const auto hollow = [&](double t) { return s.inHollow(origin + t * direction); };
  if (!(step > 0.0) || !hollow(enter + 1e-6 * step)) {
    at = enter;
    return true;
  }
  double inside = enter + 1e-6 * step;
  for (int i = 1; i <= SAMPLES; ++i) {
    double beyond = i < SAMPLES ? enter + i * step : filled.leave - 1e-6 * step;
    if (hollow(beyond)) {
      inside = beyond;
      continue;
    }
    for (int k = 0; k < BISECTIONS; ++k) {
      const double middle = 0.5 * (inside + beyond);
      (hollow(middle) ? inside : beyond) = middle;
    }
    at = beyond;
    return true;
  }
  return false; // out over the rim again
}

} // namespace pcl_sq
