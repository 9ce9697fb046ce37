// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/bend.h"

namespace pcl_sq {

namespace detail {

namespace {

LogGauge gaugeAt(const Superquadric& s, const Eigen::Vector3d& straight) {
  return logGauge(straight, s.semi_axes, s.epsilon1, s.epsilon2);
}

/** \brief d ln G for all parameters at a place, the gradient given. */
Vector13
derivatives(const Superquadric& s, const Place& p, const Eigen::Vector3d& gradient) {
  const double share_x = p.gauge.outer_h * p.gauge.inner_x;
  const double share_y = p.gauge.outer_h * p.gauge.inner_y;
  const Eigen::Vector3d& f = p.growth;
  const double height = p.unbent.z() / s.semi_axes.z();
  Vector13 d;
  d.head<3>() = -gradient;
  d.segment<3>(3) = gradient.cross(p.at);
  d[6] = -share_x;
  d[7] = -share_y;
  d[8] = -p.gauge.outer_z;
  if (s.isTapered())
    d[8] += height * (share_x * s.kx / f.x() + share_y * s.ky / f.y());
  d[9] = 0.5 * p.gauge.outer_entropy;
  d[10] = 0.5 * p.gauge.outer_h * p.gauge.inner_entropy;
  d[11] = -share_x * height / f.x();
  d[12] = -share_y * height / f.y();
  return d;
}

/** \brief Tangent plane at the radial projection, foot of the perpendicular, and back
 * onto the surface. */
Place footOf(const Superquadric& s, const Eigen::Vector3d& local, double& distance) {
  const Place place = placeOf(s, local);
  const Place first = radiallyProjected(s, place);
  const Eigen::Vector3d normal = logGradient(s, first).normalized();
  const double step = normal.dot(local - first.at);
  Eigen::Vector3d on_plane = local - step * normal;
  if (!s.isBent() && isFlat(s.semi_axes)) {
    const AlongAxis near = nearestAlongAxes(
        place.straight, s.semi_axes, s.epsilon1, s.epsilon2, place.growth);
    if (near.away < std::abs(step))
      on_plane = near.at.cwiseProduct(place.growth);
  }
  Place second = radiallyProjected(s, placeOf(s, on_plane));
  distance = std::min((local - second.at).norm(), (local - first.at).norm());
  if (!(place.gauge.value > 0.0))
    distance = -distance;
  return second;
}

} // namespace

Place placeOf(const Superquadric& s, const Eigen::Vector3d& local) {
  Place p;
  p.at = local;
  p.unbent = unbent(s, local);
  p.growth = growth(s, p.unbent.z());
  p.straight = p.unbent.cwiseQuotient(p.growth);
  p.gauge = gaugeAt(s, p.straight);
  return p;
}

Eigen::Vector3d logGradient(const Superquadric& s, const Place& p) {
  Eigen::Vector3d g = logGaugeGradient(p.gauge, p.straight);
  const auto turned = [&](const Eigen::Vector3d& unbent_gradient) -> Eigen::Vector3d {
    if (!s.isBent())
      return unbent_gradient;
    Eigen::Vector3d across = unbent_gradient; // fibres are longer or shorter
    across.z() /= std::max(fibre(s, p.unbent), 1e-9);
    return bentFrame(s, p.unbent.z()).axes * across;
  };
  if (!s.isTapered())
    return turned(g);
  const double share_x = p.gauge.outer_h * p.gauge.inner_x;
  const double share_y = p.gauge.outer_h * p.gauge.inner_y;
  const double a3 = s.semi_axes.z();
  g.x() /= p.growth.x();
  g.y() /= p.growth.y();
  g.z() -= share_x * s.kx / (a3 * p.growth.x()) + share_y * s.ky / (a3 * p.growth.y());
  return turned(g);
}

Place radiallyProjected(const Superquadric& s, const Place& p) {
  Place q = p; // the shares stay the same along a ray of the straight body
  const double scale = std::exp(-p.gauge.value);
  if (p.straight.squaredNorm() > 1e-200 && std::isfinite(scale))
    q.straight = p.straight * scale;
  else { // the centre: the end of the shortest semi-axis
    Eigen::Index k;
    const double a = s.semi_axes.minCoeff(&k);
    q.straight = a * Eigen::Vector3d::Unit(k);
    q.gauge = gaugeAt(s, q.straight);
  }
  q.gauge.value = 0.0;
  q.growth = growth(s, q.straight.z());
  q.unbent = q.straight.cwiseProduct(q.growth);
  q.at = bent(s, q.unbent);
  return q;
}

PCL_SQ_EXPORTS Eigen::Vector3d deformed(const Superquadric& s, // pictures need it
                                        const Eigen::Vector3d& straight) {
  return bent(s, straight.cwiseProduct(growth(s, straight.z())));
}

PCL_SQ_EXPORTS Eigen::Vector3d deformedAreaVector(const Superquadric& s,
                                                  const Eigen::Vector3d& straight,
                                                  const Eigen::Vector3d& normal) {
  Eigen::Vector3d upright = taperedAreaVector(s, straight, normal);
  if (!s.isBent())
    return upright;
  // cofactors of the bend's derivative: a turn, and fibres that grow
  const double longer = fibre(s, straight.cwiseProduct(growth(s, straight.z())));
  return bentFrame(s, straight.z()).axes *
         Eigen::Vector3d(longer * upright.x(), longer * upright.y(), upright.z());
}

BodyRow logGaugeRow(const Superquadric& s, const Eigen::Vector3d& point) {
  const Place p = placeOf(s, s.toLocal(point));
  return {p.gauge.value, derivatives(s, p, logGradient(s, p))};
}

BodyRow
footPointRow(const Superquadric& s, const Eigen::Vector3d& point, Place* place) {
  BodyRow row;
  const Place foot = footOf(s, s.toLocal(point), row.value);
  if (place)
    *place = foot;
  const Eigen::Vector3d g = logGradient(s, foot);
  row.derivatives = derivatives(s, foot, g) / std::max(g.norm(), 1e-300);
  return row;
}

double residualAt(const Superquadric& s,
                  const Eigen::Vector3d& point,
                  kernels::Residual residual) {
  switch (residual) {
  case kernels::Residual::RADIAL:
    return s.radialDistance(point);
  case kernels::Residual::FIRST_ORDER:
    return s.firstOrderDistance(point);
  case kernels::Residual::FOOT_POINT: {
    double distance = 0.0;
    if (!s.isDeformed() || s.isCut())
      return s.footPointDistance(point);
    footOf(s, s.toLocal(point), distance); // without its derivatives
    return distance;
  }
  case kernels::Residual::GAUGE:
    return s.gauge(point) - 1.0;
  case kernels::Residual::SOLINA:
    return std::pow(s.gauge(point), 2) - 1.0;
  }
  return 0.0;
}

void residualsOf(const Superquadric& s,
                 const UnitPoints& points,
                 kernels::Residual residual,
                 float* out) {
  if (s.isPlain()) {
    kernels::kernels().residuals(points.view(), toShape(s), residual, out);
    return;
  }
  if (s.isCut()) {
    openResiduals(s, points, residual, out);
    return;
  }
  if (!s.isBent() && residual == kernels::Residual::FOOT_POINT) {
    kernels::kernels().taperedResiduals(points.view(), toShape(s), out);
    return;
  }
  const bool as_fitted =
      s.isBent() && s.bend_angle == 0.0 && s.epsilon2 == 1.0 && !s.isTapered();
  if (as_fitted && residual == kernels::Residual::FOOT_POINT) {
    kernels::kernels().bentResiduals(points.view(), toShape(s), float(s.bend), out);
    return;
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    out[i] = static_cast<float>(residualAt(s, points[i].cast<double>(), residual));
}

} // namespace detail

Eigen::Vector3d Superquadric::deformed(const Eigen::Vector3d& point) const {
  return toWorld(detail::deformed(*this, toLocal(point)));
}

Eigen::Vector3d Superquadric::straightened(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d unbent = detail::unbent(*this, toLocal(point));
  return toWorld(unbent.cwiseQuotient(detail::growth(*this, unbent.z())));
}

Eigen::Vector3d Superquadric::bentHalfSizes() const {
  return detail::bentHalfSizes(*this);
}

} // namespace pcl_sq
