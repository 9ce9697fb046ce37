// SPDX-License-Identifier: BSD-3-Clause
#include "families/vessel_profile.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief The profile's places alone. */
struct Places {
  std::array<Eigen::Vector2d, VesselProfile::OUTER + 2> outside;
  std::array<Eigen::Vector2d, VesselProfile::INNER + 2> inside;
};

double latitude(double height, double epsilon) {
  return std::copysign(
      std::asin(std::pow(std::min(std::abs(height), 1.0), 1.0 / epsilon)), height);
}

Places placesOf(const Superquadric& s) {
  Places p;
  const double a = s.semi_axes.x(), a3 = s.semi_axes.z();
  const auto at = [&](double eta, double inset) {
    const double sine = std::sin(eta);
    const double h = std::copysign(std::pow(std::abs(sine), s.epsilon1), sine);
    const double cosine = std::cos(eta); // at the pole not quite zero
    const double g = cosine > 1e-12 ? std::pow(cosine, s.epsilon1) : 0.0;
    return Eigen::Vector2d(std::max(a * (1.0 + s.kx * h) * g - inset, 0.0), a3 * h);
  };
  const double top = latitude(s.rim, s.epsilon1);
  for (int i = 0; i <= VesselProfile::OUTER; ++i)
    p.outside[std::size_t(i)] =
        at(-M_PI_2 + (top + M_PI_2) * i / VesselProfile::OUTER, 0.0);
  const double floor = latitude(std::min(s.wall / a3 - 1.0, s.rim), s.epsilon1);
  for (int i = 0; i <= VesselProfile::INNER; ++i)
    p.inside[std::size_t(i + 1)] =
        at(floor + (top - floor) * i / VesselProfile::INNER, s.wall);
  p.inside[0] = {0.0, p.inside[1].y()};
  p.outside[VesselProfile::OUTER + 1] = p.inside[VesselProfile::INNER + 1];
  return p;
}

/** \brief A vessel with one of its shape's parameters moved. */
Superquadric nudged(Superquadric s, int i, double step) {
  switch (i) {
  case 0:
    s.semi_axes.head<2>() *= std::exp(step);
    break;
  case 1:
    s.semi_axes.z() *= std::exp(step);
    break;
  case 2:
    s.epsilon1 += step;
    break;
  case 3:
    s.kx += step;
    s.ky = s.kx;
    break;
  case 4:
    s.rim += step;
    break;
  default:
    s.wall *= std::exp(step);
  }
  return s;
}

} // namespace

VesselProfile::VesselProfile(const Superquadric& s) {
  constexpr double STEP = 1e-5;
  const Places here = placesOf(s);
  for (std::size_t i = 0; i < outside.size(); ++i)
    outside[i].at = here.outside[i];
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i].at = here.inside[i];
  for (int k = 0; k < 6; ++k) {
    const Places there = placesOf(nudged(s, k, STEP));
    for (std::size_t i = 0; i < outside.size(); ++i)
      outside[i].d.col(k) = (there.outside[i] - here.outside[i]) / STEP;
    for (std::size_t i = 0; i < inside.size(); ++i)
      inside[i].d.col(k) = (there.inside[i] - here.inside[i]) / STEP;
  }
}

} // namespace pcl_sq::detail
