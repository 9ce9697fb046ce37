// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric.h"

#include <random>

namespace pcl_sq::test {

/** \brief Repeatable random shapes, poses and points. */
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double normal(double sigma = 1.0) {
    return std::normal_distribution<double>(0.0, sigma)(engine_);
  }
  Eigen::Vector3d direction() {
    return Eigen::Vector3d(normal(), normal(), normal()).normalized();
  }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(normal(), normal(), normal(), normal())
        .normalized()
        .toRotationMatrix();
  }
  /** \brief Any convex superquadric of household size in any pose. */
  Superquadric superquadric() {
    Superquadric s;
    s.center = {uniform(-1, 1), uniform(-1, 1), uniform(0.5, 2)};
    s.rotation = rotation();
    s.semi_axes = {uniform(0.01, 0.2), uniform(0.01, 0.2), uniform(0.01, 0.2)};
    s.epsilon1 = uniform(0.05, 2);
    s.epsilon2 = uniform(0.05, 2);
    return s;
  }
  /** \brief A point inside or outside, within two semi-axes of the centre. */
  Eigen::Vector3d pointNear(const Superquadric& s) {
    return s.toWorld(Eigen::Vector3d(uniform(-2, 2), uniform(-2, 2), uniform(-2, 2))
                         .cwiseProduct(s.semi_axes));
  }
  /** \brief A point of the surface, uniform in direction (not in area). */
  Eigen::Vector3d surfacePoint(const Superquadric& s) {
    return s.radialProjection(s.toWorld(direction().cwiseProduct(s.semi_axes)));
  }
  std::mt19937& engine() { return engine_; }

private:
  std::mt19937 engine_;
};

/** \brief With one parameter moved, in the order of the derivatives' rows: place, turn,
 * logarithm of the sides, exponents, taper, bend. */
inline Superquadric moved(Superquadric s, int i, double step) {
  Eigen::Vector3d unit = Eigen::Vector3d::Zero();
  unit[i % 3] = 1.0;
  if (i < 3)
    s.center += s.rotation * unit * step;
  else if (i < 6)
    s.rotation *= Eigen::AngleAxisd(step, unit).toRotationMatrix();
  else if (i < 9)
    s.semi_axes[i - 6] *= std::exp(step);
  else
    (i == 9    ? s.epsilon1
     : i == 10 ? s.epsilon2
     : i == 11 ? s.kx
     : i == 12 ? s.ky
               : s.bend) += step;
  return s;
}

} // namespace pcl_sq::test
