// SPDX-License-Identifier: BSD-3-Clause
#include "taper_row.h"

#include "gauge.h"

namespace pcl_sq {

namespace {

using detail::LogGauge;

/** \brief Growth of the section at a height; never below that of the largest taper. */
Eigen::Vector3d growth(const TaperedSuperquadric& s, double z) {
  constexpr double LEAST = 1.0 - TaperedSuperquadric::MAX_TAPER;
  const double height = z / s.shape.semi_axes.z();
  return {
      std::max(1.0 + s.kx * height, LEAST), std::max(1.0 + s.ky * height, LEAST), 1.0};
}

/** \brief A place in the own frame, with the gauge at the untapered place. */
struct Place {
  Eigen::Vector3d at, untapered;
  LogGauge gauge;
};

LogGauge gaugeAt(const TaperedSuperquadric& s, const Eigen::Vector3d& untapered) {
  return detail::logGauge(
      untapered, s.shape.semi_axes, s.shape.epsilon1, s.shape.epsilon2);
}

Place placeOf(const TaperedSuperquadric& s, const Eigen::Vector3d& local) {
  Place p;
  p.at = local;
  p.untapered = local.cwiseQuotient(growth(s, local.z()));
  p.gauge = gaugeAt(s, p.untapered);
  return p;
}

/** \brief The radial projection before tapering, tapered; shares stay the same. */
Place projected(const TaperedSuperquadric& s, const Place& p) {
  Place q = p;
  const double scale = std::exp(-p.gauge.value);
  if (p.untapered.squaredNorm() > 1e-200 && std::isfinite(scale))
    q.untapered = p.untapered * scale;
  else { // the centre: the end of the shortest semi-axis
    Eigen::Index k;
    const double a = s.shape.semi_axes.minCoeff(&k);
    q.untapered = a * Eigen::Vector3d::Unit(k);
    q.gauge = gaugeAt(s, q.untapered);
  }
  q.gauge.value = 0.0;
  q.at = q.untapered.cwiseProduct(growth(s, q.untapered.z()));
  return q;
}

/** \brief Gradient of ln G in the own frame, by the chain rule through the taper. */
Eigen::Vector3d gradient(const TaperedSuperquadric& s, const Place& p) {
  const Eigen::Vector3d g = detail::logGaugeGradient(p.gauge, p.untapered);
  const Eigen::Vector3d f = growth(s, p.at.z());
  const double share_x = p.gauge.outer_h * p.gauge.inner_x;
  const double share_y = p.gauge.outer_h * p.gauge.inner_y;
  const double a3 = s.shape.semi_axes.z();
  return {g.x() / f.x(),
          g.y() / f.y(),
          g.z() - share_x * s.kx / (a3 * f.x()) - share_y * s.ky / (a3 * f.y())};
}

/** \brief Tangent plane at the projection, foot of the perpendicular, and back onto the
 * surface. */
Place footOf(const TaperedSuperquadric& s,
             const Eigen::Vector3d& local,
             double& signed_distance) {
  const Place place = placeOf(s, local);
  const Place first = projected(s, place);
  const Eigen::Vector3d normal = gradient(s, first).normalized();
  const Eigen::Vector3d on_plane = local - normal.dot(local - first.at) * normal;
  const Place second = projected(s, placeOf(s, on_plane));
  const double distance =
      std::min((local - second.at).norm(), (local - first.at).norm());
  signed_distance = place.gauge.value > 0.0 ? distance : -distance;
  return second;
}

/** \brief d ln G for all parameters at a place, the gradient given. */
detail::Vector13
derivatives(const TaperedSuperquadric& s, const Place& p, const Eigen::Vector3d& g) {
  const double share_x = p.gauge.outer_h * p.gauge.inner_x;
  const double share_y = p.gauge.outer_h * p.gauge.inner_y;
  const Eigen::Vector3d f = growth(s, p.at.z());
  const double height = p.at.z() / s.shape.semi_axes.z();
  detail::Vector13 d;
  d.head<3>() = -g;
  d.segment<3>(3) = g.cross(p.at);
  d[6] = -share_x;
  d[7] = -share_y;
  d[8] = -p.gauge.outer_z + height * (share_x * s.kx / f.x() + share_y * s.ky / f.y());
  d[9] = 0.5 * p.gauge.outer_entropy;
  d[10] = 0.5 * p.gauge.outer_h * p.gauge.inner_entropy;
  d[11] = -share_x * height / f.x();
  d[12] = -share_y * height / f.y();
  return d;
}

} // namespace

namespace detail {

TaperRow taperRow(const TaperedSuperquadric& s, const Eigen::Vector3d& point) {
  TaperRow row;
  const Place foot = footOf(s, s.shape.toLocal(point), row.residual);
  const Eigen::Vector3d g = gradient(s, foot);
  row.derivatives = derivatives(s, foot, g) / std::max(g.norm(), 1e-300);
  return row;
}

TaperRow taperLogGauge(const TaperedSuperquadric& s, const Eigen::Vector3d& point) {
  const Place p = placeOf(s, s.shape.toLocal(point));
  return {p.gauge.value, derivatives(s, p, gradient(s, p))};
}

} // namespace detail

bool TaperedSuperquadric::isValid(std::string* why) const {
  for (const double k : {kx, ky})
    if (!(std::abs(k) <= MAX_TAPER)) {
      if (why)
        *why = "a taper is " + std::to_string(k) + "; it must lie within +-0.95";
      return false;
    }
  return shape.isValid(why);
}

Eigen::Vector3d TaperedSuperquadric::tapered(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = shape.toLocal(point);
  return shape.toWorld(local.cwiseProduct(growth(*this, local.z())));
}

Eigen::Vector3d TaperedSuperquadric::untapered(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = shape.toLocal(point);
  return shape.toWorld(local.cwiseQuotient(growth(*this, local.z())));
}

double TaperedSuperquadric::gauge(const Eigen::Vector3d& point) const {
  return std::exp(placeOf(*this, shape.toLocal(point)).gauge.value);
}

Eigen::Vector3d
TaperedSuperquadric::radialProjection(const Eigen::Vector3d& point) const {
  return shape.toWorld(projected(*this, placeOf(*this, shape.toLocal(point))).at);
}

double TaperedSuperquadric::footPointDistance(const Eigen::Vector3d& point) const {
  double distance;
  footOf(*this, shape.toLocal(point), distance);
  return distance;
}

namespace {

/** \brief Integral of z^2 over the body before tapering, in its own frame. */
double secondMoment(const Superquadric& shape) {
  Superquadric own = shape;
  own.rotation.setIdentity();
  const Eigen::Vector3d i = own.inertia().diagonal();
  return 0.5 * (i.x() + i.y() - i.z());
}

} // namespace

double TaperedSuperquadric::volume() const {
  const double a3 = shape.semi_axes.z();
  return shape.volume() + kx * ky * secondMoment(shape) / (a3 * a3);
}

Eigen::Vector3d TaperedSuperquadric::centerOfGravity() const {
  const double along = (kx + ky) * secondMoment(shape) / shape.semi_axes.z();
  return shape.toWorld({0.0, 0.0, along / volume()});
}

TriangleMesh meshSuperquadric(const TaperedSuperquadric& superquadric, int divisions) {
  TriangleMesh mesh = meshSuperquadric(superquadric.shape, divisions);
  for (Eigen::Vector3d& v : mesh.vertices)
    v = superquadric.tapered(v);
  return mesh;
}

} // namespace pcl_sq
