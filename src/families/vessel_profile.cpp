// SPDX-License-Identifier: BSD-3-Clause
#include "families/vessel_profile.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using Slopes = Eigen::Matrix<double, 1, 6>; ///< for ln a, ln a3, e1, k, rim, ln wall
enum Parameter { LN_A, LN_A3, E1, TAPER, RIM, LN_WALL };

/** \brief Of a sine, what rounding leaves: at the equator a height moves without
 * bounds. */
constexpr double NEAR_EQUATOR = 1e-16;
constexpr double NEAR_POLE = 1e-12; ///< of a cosine

/** \brief An angle of the meridian and how it moves with the parameters. */
struct Latitude {
  double eta = 0.0;
  Slopes d = Slopes::Zero();
};

/** \brief That of a height over a3, sin(eta) = height^(1 / e1). \param[in] by how the
 * height moves */
Latitude latitudeAt(double height, const Slopes& by, double epsilon) {
  const double h = std::clamp(std::abs(height), 1e-12, 1.0);
  const double sine = std::pow(h, 1.0 / epsilon);
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, NEAR_POLE));
  Latitude l;
  l.eta = std::copysign(std::asin(sine), height);
  l.d = sine / (epsilon * h * cosine) * by;
  // the logarithm is negative: with e1 the angle grows
  l.d[E1] += std::copysign(-sine * std::log(h) / (epsilon * epsilon * cosine), height);
  return l;
}

/** \brief Where the meridian is at a latitude, nearer to the axis by an inset. */
ProfileVertex placeAt(const Superquadric& s, const Latitude& l, double inset) {
  const double a = s.semi_axes.x(), a3 = s.semi_axes.z(), e = s.epsilon1;
  const double sine = std::sin(l.eta), cosine = std::max(std::cos(l.eta), 0.0);
  const double log_sine = std::log(std::max(std::abs(sine), 1e-300));
  const double h = std::copysign(std::exp(e * log_sine), sine);
  double g = 0.0, g_by_e = 0.0, g_by_eta = 0.0;
  if (cosine > NEAR_POLE) {
    const double log_cosine = std::log(cosine);
    g = std::exp(e * log_cosine);
    g_by_e = g * log_cosine;
    g_by_eta = -e * g * sine / cosine;
  }
  const double h_by_e = h * log_sine;
  const double h_by_eta =
      e * h * cosine / std::copysign(std::max(std::abs(sine), NEAR_EQUATOR), sine);
  const double growth = 1.0 + s.kx * h;
  ProfileVertex v;
  v.at = {a * growth * g - inset, a3 * h};
  v.d.row(0) = a * (s.kx * h_by_eta * g + growth * g_by_eta) * l.d;
  v.d(0, LN_A) += a * growth * g;
  v.d(0, E1) += a * (s.kx * h_by_e * g + growth * g_by_e);
  v.d(0, TAPER) += a * h * g;
  v.d(0, LN_WALL) -= inset;
  v.d.row(1) = a3 * h_by_eta * l.d;
  v.d(1, LN_A3) += a3 * h;
  v.d(1, E1) += a3 * h_by_e;
  if (!(v.at.x() > 0.0)) { // on the axis
    v.at.x() = 0.0;
    v.d.row(0).setZero();
  }
  return v;
}

/** \brief A latitude between two. */
Latitude between(const Latitude& low, const Latitude& high, double share) {
  return {(1.0 - share) * low.eta + share * high.eta,
          (1.0 - share) * low.d + share * high.d};
}

} // namespace

VesselProfile::VesselProfile(const Superquadric& s) {
  const Latitude bottom{-M_PI_2, Slopes::Zero()};
  Slopes by = Slopes::Zero();
  by[RIM] = 1.0;
  const Latitude top = latitudeAt(s.rim, by, s.epsilon1);
  const double thick = s.wall / s.semi_axes.z();
  if (thick - 1.0 < s.rim) {
    by[RIM] = 0.0;
    by[LN_WALL] = thick;
    by[LN_A3] = -thick;
  }
  const Latitude floor = latitudeAt(std::min(thick - 1.0, s.rim), by, s.epsilon1);
  for (int i = 0; i <= OUTER; ++i)
    outside[std::size_t(i)] = placeAt(s, between(bottom, top, double(i) / OUTER), 0.0);
  for (int i = 0; i <= INNER; ++i)
    inside[std::size_t(i) + 1] =
        placeAt(s, between(floor, top, double(i) / INNER), s.wall);
  inside[0] = inside[1];
  inside[0].at.x() = 0.0;
  inside[0].d.row(0).setZero();
  outside[OUTER + 1] = inside[INNER + 1];
}

} // namespace pcl_sq::detail
