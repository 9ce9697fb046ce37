// SPDX-License-Identifier: BSD-3-Clause
// Volume, centre of gravity and inertia of a superquadric, with or without a taper, a
// bend and a rim.
#include "geometry/bend.h"

#include <cmath>

namespace pcl_sq {

namespace {

double beta(double x, double y) { // std::tgamma, not lgamma, which writes a global
  return std::tgamma(x) * std::tgamma(y) / std::tgamma(x + y);
}

} // namespace

namespace detail {

double evenMoment(const Superquadric& s, int p, int q, int r) {
  const double e1 = s.epsilon1, e2 = s.epsilon2;
  // Dirichlet's integral over the section, then along z, where the section's size is
  // (1 - |z / a3|^(2 / e1))^(e1 / 2)
  const double across = e2 * e2 * std::tgamma(0.5 * e2 * (p + 1)) *
                        std::tgamma(0.5 * e2 * (q + 1)) /
                        std::tgamma(0.5 * e2 * (p + q + 2) + 1.0);
  const double along = e1 * beta(0.5 * e1 * (r + 1), 0.5 * e1 * (p + q + 2) + 1.0);
  return std::pow(s.semi_axes.x(), p + 1) * std::pow(s.semi_axes.y(), q + 1) *
         std::pow(s.semi_axes.z(), r + 1) * across * along;
}

} // namespace detail

double Superquadric::volume() const {
  if (isCut())
    return detail::filledMoments(*this).volume;
  const double straight = 2.0 * semi_axes.prod() * epsilon1 * epsilon2 *
                          beta(0.5 * epsilon1 + 1.0, epsilon1) *
                          beta(0.5 * epsilon2, 0.5 * epsilon2);
  if (!isTapered())
    return straight;
  const double a3 = semi_axes.z();
  return straight + kx * ky * detail::evenMoment(*this, 0, 0, 2) / (a3 * a3);
}

double Superquadric::materialVolume() const {
  return isHollow() ? volume() - detail::hollowMoments(*this).volume : volume();
}

Eigen::Vector3d Superquadric::centerOfGravity() const {
  if (isCut()) {
    const detail::AxialMoments m =
        detail::filledMoments(*this) - detail::hollowMoments(*this);
    return toWorld({0.0, 0.0, m.z / m.volume});
  }
  if (isBent()) {
    const detail::BentMoments m = detail::bentMoments(*this);
    return toWorld(m.first / m.volume);
  }
  if (!isTapered())
    return center;
  const double along = (kx + ky) * detail::evenMoment(*this, 0, 0, 2) / semi_axes.z();
  return toWorld({0.0, 0.0, along / volume()});
}

Eigen::Matrix3d Superquadric::inertia() const {
  const double e1 = epsilon1, e2 = epsilon2;
  const Eigen::Vector3d a2 = semi_axes.cwiseAbs2();
  Eigen::Vector3d moments;
  if (isBent()) {
    const Eigen::Matrix3d second = detail::bentMoments(*this).second;
    return rotation * (second.trace() * Eigen::Matrix3d::Identity() - second) *
           rotation.transpose();
  }
  if (isCut()) {
    const detail::AxialMoments m =
        detail::filledMoments(*this) - detail::hollowMoments(*this);
    moments = {m.yy + m.zz, m.xx + m.zz, m.xx + m.yy};
  } else if (!isTapered()) {
    const double scale = 0.5 * semi_axes.prod() * e1 * e2;
    const double across = beta(1.5 * e2, 0.5 * e2) * beta(0.5 * e1, 2.0 * e1 + 1.0);
    const double along =
        4.0 * beta(0.5 * e2, 0.5 * e2 + 1.0) * beta(1.5 * e1, e1 + 1.0);
    moments = scale * Eigen::Vector3d(a2.y() * across + a2.z() * along,
                                      a2.x() * across + a2.z() * along,
                                      (a2.x() + a2.y()) * across);
  } else {
    // a volume element grows by f_x f_y, its x by f_x; odd powers of z cancel
    const auto m = [this](int p, int q, int r) {
      return detail::evenMoment(*this, p, q, r) / std::pow(semi_axes.z(), r);
    };
    const double xx =
        m(2, 0, 0) + 3.0 * kx * (kx + ky) * m(2, 0, 2) + kx * kx * kx * ky * m(2, 0, 4);
    const double yy =
        m(0, 2, 0) + 3.0 * ky * (ky + kx) * m(0, 2, 2) + ky * ky * ky * kx * m(0, 2, 4);
    const double zz = a2.z() * (m(0, 0, 2) + kx * ky * m(0, 0, 4));
    moments = {yy + zz, xx + zz, xx + yy};
  }
  return rotation * moments.asDiagonal() * rotation.transpose();
}

} // namespace pcl_sq
