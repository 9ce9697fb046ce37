// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/sides.h"

#include <cmath>
#include <functional>
#include <limits>

namespace pcl_sq {

namespace {

constexpr int ANGLES = 90;      ///< looked at within a right angle
constexpr int REFINEMENTS = 40; ///< golden sections: more digits than a double has

/** \brief Support function: how far a body reaches along a direction. */
using Support = std::function<double(const Eigen::Vector3d&)>;

double extent(const Support& support, const Eigen::Vector3d& n) {
  return support(n) + support(-n);
}

/** \brief The box with its third side along \a axis that has the smallest section. */
OrientedBox
smallestAlong(const Support& support, const Eigen::Matrix3d& axes, double first_angle) {
  const auto turned = [&](double angle) -> Eigen::Matrix3d {
    return axes * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  };
  const auto area = [&](double angle) {
    const Eigen::Matrix3d r = turned(angle);
    return extent(support, r.col(0)) * extent(support, r.col(1));
  };
  const double step = M_PI_2 / ANGLES;
  double best = first_angle, least = area(first_angle);
  for (int i = 1; i < ANGLES; ++i) {
    const double angle = first_angle + i * step;
    const double here = area(angle);
    if (here < least * (1.0 - 1e-9)) { // what is alike all round keeps its axes
      best = angle;
      least = here;
    }
  }
  if (best != first_angle) {
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double low = best - step, high = best + step;
    for (int i = 0; i < REFINEMENTS; ++i) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      (area(a) < area(b) ? high : low) = area(a) < area(b) ? b : a;
    }
    best = 0.5 * (low + high);
    if (best - first_angle > M_PI_4) // the first side stays near the first axis
      best -= M_PI_2;
  }
  OrientedBox box;
  box.rotation = turned(best);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d n = box.rotation.col(k);
    const double high = support(n), low = -support(-n);
    box.half_sizes[k] = 0.5 * (high - low);
    box.center += 0.5 * (high + low) * n;
  }
  return box;
}

/** \brief Any right-handed axes with the third one given. */
Eigen::Matrix3d axesWith(const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.col(2) = up.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

} // namespace

OrientedBox boxAround(const Superquadric& s) {
  OrientedBox box;
  box.center = s.center;
  box.rotation = s.rotation;
  box.half_sizes = s.semi_axes;
  if (s.isCut() || s.isBent())
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = s.rotation.col(k);
      const double high = s.support(axis),
                   low = s.isBent() || k == 2 ? -s.support(-axis) : -high;
      box.center += 0.5 * (low + high) * axis;
      box.half_sizes[k] = 0.5 * (high - low);
    }
  if (s.isBent() ||
      s.epsilon2 <= 1.0) // a rectangle with round corners fills its box best
    return box;
  box = smallestAlong(
      [&s](const Eigen::Vector3d& n) { return n.dot(s.center) + s.support(n); },
      s.rotation,
      0.0);
  return box;
}

Eigen::Vector3d sidesOf(const Superquadric& superquadric) {
  return 2.0 * boxAround(superquadric).half_sizes;
}

OrientedBox boxAround(const MultiSuperquadric& model,
                      const std::optional<Eigen::Vector3d>& up) {
  OrientedBox best;
  if (model.empty())
    return best;
  const Support support = [&model](const Eigen::Vector3d& n) {
    return model.support(n);
  };
  std::vector<Eigen::Matrix3d> axes;
  if (up)
    axes.push_back(axesWith(*up));
  else
    for (const Superquadric& part : model.parts)
      for (int k = 0; k < 3; ++k) {
        Eigen::Matrix3d r;
        for (int i = 0; i < 3; ++i)
          r.col(i) = part.rotation.col((i + k + 1) % 3);
        axes.push_back(r);
      }
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& r : axes) {
    OrientedBox box = smallestAlong(support, r, 0.0);
    const double volume = box.half_sizes.prod();
    if (volume < least * (1.0 - 1e-9)) {
      least = volume;
      best = box;
    }
  }
  if (best.half_sizes[0] < best.half_sizes[1]) {
    std::swap(best.half_sizes[0], best.half_sizes[1]);
    const Eigen::Vector3d first = best.rotation.col(0);
    best.rotation.col(0) = best.rotation.col(1);
    best.rotation.col(1) = -first;
  }
  return best;
}

} // namespace pcl_sq
