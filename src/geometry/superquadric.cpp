// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/superquadric.h"

#include "geometry/bend.h"

#include <limits>

namespace pcl_sq {

namespace {

using detail::LogGauge;
using detail::Place;

constexpr double HUGE_VALUE = std::numeric_limits<double>::max();

/** \brief exp() that saturates at the largest double instead of overflowing. */
double saturatedExp(double x) {
  return x > 709.0 ? HUGE_VALUE : std::exp(x);
}

/** \brief Exponents with which the dual body is evaluated: e' = 2 - e. */
double dualEpsilon(double epsilon) {
  return std::max(2.0 - epsilon, 1e-6);
}

/** \brief What a rim adds to the gauge: one on its plane, growing with the height. */
double aboveRim(const Superquadric& s, const Eigen::Vector3d& local) {
  return 1.0 + local.z() / s.semi_axes.z() - s.rimHeight();
}

/** \brief Support function in the own frame (M3): the dual gauge of a_k u_k. */
LogGauge logSupport(const Superquadric& s, const Eigen::Vector3d& u) {
  return detail::logGauge(
      u, s.semi_axes.cwiseInverse(), dualEpsilon(s.epsilon1), dualEpsilon(s.epsilon2));
}

/** \brief Contact point of the supporting plane in the own frame, c_k = dh / du_k. */
Eigen::Vector3d contactPoint(const LogGauge& h, const Eigen::Vector3d& u) {
  return std::exp(h.value) * detail::logGaugeGradient(h, u);
}

} // namespace

bool Superquadric::isValid(std::string* why) const {
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  if (!center.allFinite() || !rotation.allFinite() || !semi_axes.allFinite() ||
      !std::isfinite(epsilon1) || !std::isfinite(epsilon2))
    return fail("a parameter is not finite");
  if (semi_axes.minCoeff() <= 0.0)
    return fail("a semi-axis is not positive");
  // Moments of inertia are fifth powers of lengths, and squares of them are summed: the
  // tenth power of these, and some more, is still a double.
  constexpr double SMALLEST = 1e-20, LARGEST = 1e20;
  if (semi_axes.minCoeff() < SMALLEST || semi_axes.maxCoeff() > LARGEST)
    return fail("a semi-axis is outside [1e-20, 1e20] m");
  if (center.cwiseAbs().maxCoeff() > LARGEST)
    return fail("the centre is farther than 1e20 m from the origin");
  for (const double epsilon : {epsilon1, epsilon2})
    if (epsilon < MIN_EPSILON || epsilon > MAX_EPSILON)
      return fail("an exponent is outside [0.05, 2]");
  for (const double taper : {kx, ky})
    if (!(std::abs(taper) <= MAX_TAPER))
      return fail("a taper is outside [-0.95, 0.95]");
  if (!(rim > -1.0 && rim <= 1.0))
    return fail("a rim is outside (-1, 1]");
  if (!(wall >= 0.0 && wall <= LARGEST))
    return fail("a wall is negative or not finite");
  if (isHollow()) {
    if (!(detail::floorHeight(*this) < rimHeight()))
      return fail("a wall is thicker than the body is deep below its rim");
    if (detail::sectionAt(*this, rimHeight(), wall).empty())
      return fail("a wall is thicker than half the body's width at its rim");
  }
  if (const char* bent = detail::invalidBend(*this))
    return fail(bent);
  const Eigen::Matrix3d gram = rotation.transpose() * rotation;
  if ((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-6 ||
      rotation.determinant() <= 0.0)
    return fail("the rotation matrix is not orthonormal and right-handed");
  return true;
}

double Superquadric::insideOutside(const Eigen::Vector3d& point) const {
  if (isCut())
    return saturatedExp(2.0 / epsilon1 * std::log(gauge(point)));
  return saturatedExp(2.0 / epsilon1 *
                      detail::placeOf(*this, toLocal(point)).gauge.value);
}

Eigen::Vector3d
Superquadric::insideOutsideGradient(const Eigen::Vector3d& point) const {
  if (isCut()) { // dF = (2 / e1) G^(2 / e1 - 1) dG
    const double slope = 2.0 / epsilon1;
    const double factor =
        saturatedExp(std::log(slope) + (slope - 1.0) * std::log(gauge(point)));
    const Eigen::Vector3d gradient = gaugeGradient(point);
    return (factor * gradient).cwiseMax(-HUGE_VALUE).cwiseMin(HUGE_VALUE);
  }
  const Place place = detail::placeOf(*this, toLocal(point));
  const double f = saturatedExp(2.0 / epsilon1 * place.gauge.value);
  const Eigen::Vector3d gradient =
      rotation * ((2.0 / epsilon1) * detail::logGradient(*this, place));
  return (f * gradient).cwiseMax(-HUGE_VALUE).cwiseMin(HUGE_VALUE);
}

double Superquadric::gauge(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = toLocal(point);
  const double whole =
      local.isZero(0.0) ? 0.0 : std::exp(detail::placeOf(*this, local).gauge.value);
  return isCut() ? std::max(whole, aboveRim(*this, local)) : whole;
}

Eigen::Vector3d Superquadric::gaugeGradient(const Eigen::Vector3d& point) const {
  const Place place = detail::placeOf(*this, toLocal(point));
  if (isCut() && aboveRim(*this, place.at) > std::exp(place.gauge.value))
    return rotation.col(2) / semi_axes.z();
  return rotation * (std::exp(place.gauge.value) * detail::logGradient(*this, place));
}

SuperquadricCoefficients
Superquadric::logGaugeJacobian(const Eigen::Vector3d& point) const {
  return detail::logGaugeRow(*this, point).derivatives.head<11>();
}

Eigen::Vector3d Superquadric::radialProjection(const Eigen::Vector3d& point) const {
  if (isCut())
    return closestPoint(point);
  const Eigen::Vector3d local = toLocal(point);
  if (local.isZero(0.0)) {
    Eigen::Index shortest;
    const double length = semi_axes.minCoeff(&shortest);
    return toWorld(length * Eigen::Vector3d::Unit(shortest));
  }
  const Place place = detail::placeOf(*this, local);
  const Eigen::Vector3d straight = place.straight * std::exp(-place.gauge.value);
  return toWorld(detail::deformed(*this, straight));
}

double Superquadric::radialDistance(const Eigen::Vector3d& point) const {
  if (isCut())
    return footPointDistance(point);
  const Eigen::Vector3d local = toLocal(point);
  if (local.isZero(0.0))
    return -semi_axes.minCoeff();
  const Place place = detail::placeOf(*this, local);
  if (!isDeformed())
    return -local.norm() * std::expm1(-place.gauge.value); // |y| (1 - 1/G)
  const double distance = (local - detail::radiallyProjected(*this, place).at).norm();
  return std::copysign(distance, place.gauge.value);
}

double Superquadric::firstOrderDistance(const Eigen::Vector3d& point) const {
  if (isCut())
    return footPointDistance(point);
  const Eigen::Vector3d local = toLocal(point);
  const Place place = detail::placeOf(*this, local);
  const double slope = detail::logGradient(*this, place).norm(); // |grad G| / G
  if (!(slope > 0.0) || local.isZero(0.0))
    return -semi_axes.minCoeff();
  return -std::expm1(-place.gauge.value) / slope;
}

double Superquadric::footPointDistance(const Eigen::Vector3d& point) const {
  if (isCut())
    return detail::meridianDistance(*this, toLocal(point));
  if (isDeformed())
    return detail::footPointRow(*this, point).value;
  const Eigen::Vector3d local = toLocal(point);
  const double radial = radialDistance(point);
  const LogGauge g = detail::logGauge(local, semi_axes, epsilon1, epsilon2);
  const Eigen::Vector3d gradient = detail::logGaugeGradient(g, local);
  const double slope2 = gradient.squaredNorm();
  if (!(slope2 > 0.0) || local.isZero(0.0))
    return radial;
  // the tangent plane at the radial projection, then back onto the surface
  const Eigen::Vector3d radial_point = local * std::exp(-g.value);
  const double step = (local - radial_point).dot(gradient) / slope2;
  Eigen::Vector3d foot = local - gradient * step;
  if (detail::isFlat(semi_axes)) {
    const detail::AlongAxis near = detail::nearestAlongAxes(
        local, semi_axes, epsilon1, epsilon2, Eigen::Vector3d::Ones());
    if (near.away < std::abs(step) * std::sqrt(slope2))
      foot = near.at;
  }
  if (foot.isZero(0.0))
    return radial;
  const LogGauge at_foot = detail::logGauge(foot, semi_axes, epsilon1, epsilon2);
  const double distance = (local - foot * std::exp(-at_foot.value)).norm();
  return std::copysign(std::min(distance, std::abs(radial)), g.value);
}

double Superquadric::euclideanDistance(const Eigen::Vector3d& point) const {
  if (isCut() && detail::isRound(*this)) // the same, without a search
    return footPointDistance(point);
  const double distance = (point - closestPoint(point)).norm();
  return std::copysign(distance, inHollow(point) ? 1.0 : gauge(point) - 1.0);
}

Eigen::Vector3d Superquadric::normal(const Eigen::Vector3d& point) const {
  if (isCut())
    return rotation * detail::nearestPlace(*this, toLocal(point)).normal;
  const Eigen::Vector3d gradient = gaugeGradient(point);
  const double length = gradient.norm();
  if (length > 0.0)
    return gradient / length;
  Eigen::Index shortest;
  semi_axes.minCoeff(&shortest);
  return rotation.col(shortest);
}

double Superquadric::support(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d u = rotation.transpose() * direction;
  if (!isPlain())
    return detail::slicedSupport(*this, u);
  return u.isZero(0.0) ? 0.0 : std::exp(logSupport(*this, u).value);
}

Eigen::Vector3d Superquadric::supportPoint(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d u = rotation.transpose() * direction;
  if (!isPlain())
    return toWorld(detail::slicedSupportPoint(*this, u));
  return toWorld(contactPoint(logSupport(*this, u), u));
}

SuperquadricCoefficients
Superquadric::supportJacobian(const Eigen::Vector3d& direction) const {
  double h;
  return supportJacobian(direction, h);
}

SuperquadricCoefficients Superquadric::supportJacobian(const Eigen::Vector3d& direction,
                                                       double& support) const {
  if (!isPlain()) {
    const detail::BodyRow row = detail::supportRow(*this, direction);
    support = row.value - direction.dot(center);
    return row.derivatives.head<11>();
  }
  const Eigen::Vector3d u = rotation.transpose() * direction;
  const LogGauge g = logSupport(*this, u);
  const double h = std::exp(g.value);
  support = u.isZero(0.0) ? 0.0 : h;
  const Eigen::Vector3d contact = h * detail::logGaugeGradient(g, u);
  SuperquadricCoefficients jacobian;
  jacobian.segment<3>(0) = u;
  jacobian.segment<3>(3) = contact.cross(u);
  jacobian.segment<3>(6) = u.cwiseProduct(contact);
  jacobian[9] = -0.5 * h * g.outer_entropy;
  jacobian[10] = -0.5 * h * g.outer_h * g.inner_entropy;
  return jacobian;
}

Eigen::AlignedBox3d Superquadric::boundingBox() const {
  Eigen::Vector3d above, below;
  for (int k = 0; k < 3; ++k) {
    above[k] = support(Eigen::Vector3d::Unit(k));
    below[k] = isPlain() ? above[k] : support(-Eigen::Vector3d::Unit(k));
  }
  return {center - below, center + above};
}

SuperquadricCoefficients Superquadric::toCoefficients() const {
  SuperquadricCoefficients c;
  const Eigen::Matrix3d& r = rotation; // R = Rz(yaw) Ry(pitch) Rx(roll)
  c << center, std::atan2(r(2, 1), r(2, 2)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
      std::atan2(r(1, 0), r(0, 0)), semi_axes, epsilon1, epsilon2;
  return c;
}

Superquadric Superquadric::fromCoefficients(const SuperquadricCoefficients& c) {
  Superquadric s;
  s.center = c.segment<3>(0);
  s.rotation = (Eigen::AngleAxisd(c[5], Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(c[4], Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(c[3], Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  s.semi_axes = c.segment<3>(6);
  s.epsilon1 = c[9];
  s.epsilon2 = c[10];
  return s;
}

Superquadric Superquadric::fromCoefficients(const Eigen::VectorXf& coefficients) {
  Eigen::VectorXf c = coefficients; // what is missing is zero, and no exponent may be
  c.conservativeResizeLike(Eigen::VectorXf::Zero(11));
  return fromCoefficients(SuperquadricCoefficients(c.cast<double>()));
}

Superquadric Superquadric::fromCoefficients(const std::vector<float>& coefficients) {
  const auto size = static_cast<Eigen::Index>(coefficients.size());
  return fromCoefficients(Eigen::VectorXf::Map(coefficients.data(), size).eval());
}

} // namespace pcl_sq
