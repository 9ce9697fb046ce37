// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/open_body.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace detail {

namespace {

constexpr int STEPS = 40;         ///< of a meridian's curve
constexpr int REFINEMENTS = 18;   ///< golden sections about the nearest chord
constexpr double STRAIGHT = 1e-5; ///< of the body's size that a chord may miss

/** \brief Latitude eta of a height over a3: height = sin^e1(eta). */
double latitudeOf(const Superquadric& s, double height) {
  const double sine = std::pow(std::min(std::abs(height), 1.0), 1.0 / s.epsilon1);
  return std::copysign(std::asin(sine), height);
}

double toSegment(const Eigen::Vector2d& p,
                 const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b) {
  const Eigen::Vector2d side = b - a;
  const double length = std::max(side.squaredNorm(), 1e-300);
  const double t = std::clamp((p - a).dot(side) / length, 0.0, 1.0);
  return (p - a - t * side).norm();
}

bool inPolygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

/** \brief Integrals between two heights over a3 of the body shrunk by an inset: Gauss's
 * rule between heights of equal steps of the latitude, which are dense at the poles,
 * where the section's size is steep. */
AxialMoments
momentsBetween(const Superquadric& s, double low, double high, double inset) {
  // area of a superellipse of unit semi-axes, and the integral of x^2 over it
  const double e2 = s.epsilon2;
  const double area = e2 * std::pow(std::tgamma(0.5 * e2), 2) / std::tgamma(e2);
  const double second = e2 * e2 * std::tgamma(1.5 * e2) * std::tgamma(0.5 * e2) /
                        std::tgamma(2.0 * e2 + 1.0);
  AxialMoments m;
  const double a3 = s.semi_axes.z();
  const auto addPiece = [&](double from, double to) {
    constexpr int PIECES = 24;
    for (int i = 0; i < PIECES; ++i) {
      const auto latitude = [&](double t) {
        return latitudeOf(s, from) + t * (latitudeOf(s, to) - latitudeOf(s, from));
      };
      const double begin = latitude(double(i) / PIECES),
                   end = latitude(double(i + 1) / PIECES);
      const auto& nodes = boost::math::quadrature::gauss<double, 15>::abscissa();
      const auto& weights = boost::math::quadrature::gauss<double, 15>::weights();
      const auto height = [&](double eta) {
        return std::copysign(std::pow(std::abs(std::sin(eta)), s.epsilon1), eta);
      };
      const double z0 = height(begin), z1 = height(end);
      const auto add = [&](double x, double weight) {
        const double z = 0.5 * (z0 + z1) + 0.5 * (z1 - z0) * x;
        const Section c = sectionAt(s, z, inset);
        const double dz = weight * 0.5 * (z1 - z0) * a3;
        m.volume += dz * area * c.a * c.b;
        m.z += dz * area * c.a * c.b * z * a3;
        m.zz += dz * area * c.a * c.b * z * z * a3 * a3;
        m.xx += dz * second * c.a * c.a * c.a * c.b;
        m.yy += dz * second * c.a * c.b * c.b * c.b;
      };
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        add(nodes[k], weights[k]);
        if (nodes[k] != 0.0)
          add(-nodes[k], weights[k]);
      }
    }
  };
  if (low < 0.0)
    addPiece(low, std::min(high, 0.0));
  if (high > 0.0)
    addPiece(std::max(low, 0.0), high);
  return m;
}

} // namespace

Section sectionAt(const Superquadric& s, double height, double inset) {
  const double h = std::min(std::abs(height), 1.0);
  const double scale = std::pow(1.0 - std::pow(h, 2.0 / s.epsilon1), 0.5 * s.epsilon1);
  const Section c{s.semi_axes.x() * (1.0 + s.kx * height) * scale - inset,
                  s.semi_axes.y() * (1.0 + s.ky * height) * scale - inset};
  return c.empty() ? Section() : c;
}

bool contains(const Section& c, double epsilon2, double x, double y) {
  if (c.empty())
    return false;
  const double u = std::abs(x) / c.a, v = std::abs(y) / c.b;
  const double larger = std::max(u, v), smaller = std::min(u, v);
  if (larger > 1.0)
    return false;
  return larger == 0.0 ||
         larger * std::pow(1.0 + std::pow(smaller / larger, 2.0 / epsilon2),
                           0.5 * epsilon2) <=
             1.0;
}

Meridian::Meridian(const Superquadric& s, const Eigen::Vector2d& direction)
    : s_(s), direction_(direction.norm() > 0.0 ? direction.normalized()
                                               : Eigen::Vector2d::UnitX()) {
  const double rim = s.rimHeight();
  addCurve(0.0, -1.0, rim);
  if (s.isHollow())
    addCurve(s.wall, floorHeight(s), rim);
  for (const Eigen::Vector2d& p : curves_[0].points)
    polygon_.push_back(p);
  if (s.isHollow())
    polygon_.insert(
        polygon_.end(), curves_[1].points.rbegin(), curves_[1].points.rend());
  polygon_.emplace_back(0.0, polygon_.back().y());
}

Eigen::Vector2d Meridian::at(double s, double inset) const {
  const double larger = std::max(std::abs(s), 1.0 - std::abs(s));
  const double ratio = std::min(std::abs(s), 1.0 - std::abs(s)) / larger;
  const double norm =
      larger * std::pow(1.0 + std::pow(ratio, 2.0 / s_.epsilon1), 0.5 * s_.epsilon1);
  const double height = s / norm, scale = (1.0 - std::abs(s)) / norm;
  const double a = s_.semi_axes.x() * (1.0 + s_.kx * height) * scale - inset;
  const double b = s_.semi_axes.y() * (1.0 + s_.ky * height) * scale - inset;
  if (!(a > 0.0 && b > 0.0))
    return {0.0, height * s_.semi_axes.z()};
  if (s_.epsilon2 == 1.0 && a == b)
    return {a, height * s_.semi_axes.z()};
  const double u = std::abs(direction_.x()) / a, v = std::abs(direction_.y()) / b;
  const double most = std::max(u, v), least = std::min(u, v);
  const double reach = most * std::pow(1.0 + std::pow(least / most, 2.0 / s_.epsilon2),
                                       0.5 * s_.epsilon2);
  return {1.0 / reach, height * s_.semi_axes.z()};
}

void Meridian::addCurve(double inset, double low, double high) {
  Curve c;
  c.inset = inset;
  const double begin = latitudeOf(s_, low), end = latitudeOf(s_, high);
  for (int i = 0; i <= STEPS; ++i) {
    const double eta = begin + (end - begin) * i / STEPS;
    const double height = std::pow(std::abs(std::sin(eta)), s_.epsilon1);
    const double scale = std::pow(std::max(std::cos(eta), 0.0), s_.epsilon1);
    const bool pole = low == -1.0 && i == 0; // where a cosine is not quite zero
    c.places.push_back(pole ? -1.0 : std::copysign(height / (height + scale), eta));
    c.points.push_back(at(c.places.back(), inset));
  }
  for (std::size_t i = 0; i < STEPS; ++i) {
    double miss = 0.0;
    for (const double share : {0.1, 0.5, 0.9})
      miss = std::max(
          miss,
          toSegment(at((1.0 - share) * c.places[i] + share * c.places[i + 1], inset),
                    c.points[i],
                    c.points[i + 1]));
    c.straight.push_back(miss < STRAIGHT * s_.semi_axes.maxCoeff());
  }
  curves_.push_back(std::move(c));
}

double Meridian::distanceTo(const Curve& c, const Eigen::Vector2d& p) const {
  double nearest = 1e300;
  std::size_t chord = 0;
  for (std::size_t i = 0; i < STEPS; ++i) {
    const double d = toSegment(p, c.points[i], c.points[i + 1]);
    if (d < nearest) {
      nearest = d;
      chord = i;
    }
  }
  if (c.straight[chord])
    return nearest;
  constexpr double GOLDEN = 0.6180339887498949;
  const auto square = [&](double s) { return (p - at(s, c.inset)).squaredNorm(); };
  double low = c.places[chord], high = c.places[chord + 1];
  if (chord > 0) // the curve's foot may lie beside the chord's
    low = 0.5 * (low + c.places[chord - 1]);
  if (chord + 2 < c.places.size())
    high = 0.5 * (high + c.places[chord + 2]);
  double left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
  double at_left = square(left), at_right = square(right);
  for (int i = 0; i < REFINEMENTS; ++i)
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = square(left = high - GOLDEN * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = square(right = low + GOLDEN * (high - low));
    }
  return std::sqrt(std::min({at_left,
                             at_right,
                             (p - c.points[chord]).squaredNorm(),
                             (p - c.points[chord + 1]).squaredNorm()}));
}

double Meridian::distance(double rho, double z) const {
  const Eigen::Vector2d p(rho, z);
  double nearest = 1e300;
  for (const Curve& c : curves_)
    nearest = std::min(nearest, distanceTo(c, p));
  const Eigen::Vector2d edge = curves_[0].points.back();
  const Eigen::Vector2d inner =
      s_.isHollow() ? curves_[1].points.back() : Eigen::Vector2d(0.0, edge.y());
  nearest = std::min(nearest, toSegment(p, inner, edge));
  if (s_.isHollow()) {
    const Eigen::Vector2d corner = curves_[1].points.front();
    nearest = std::min(nearest, toSegment(p, {0.0, corner.y()}, corner));
  }
  return inPolygon(polygon_, p) ? -nearest : nearest;
}

double meridianDistance(const Superquadric& s, const Eigen::Vector3d& local) {
  return Meridian(s, local.head<2>()).distance(local.head<2>().norm(), local.z());
}

std::vector<std::vector<Ring>> ringsOf(const Superquadric& s, int steps) {
  const double rim = s.rimHeight();
  const auto side = [&](double low, double high, double inset) {
    const double begin = latitudeOf(s, low), end = latitudeOf(s, high);
    std::vector<Ring> rings;
    for (int i = 0; i <= steps; ++i) {
      const double sine = std::sin(begin + (end - begin) * i / steps);
      double height = std::copysign(std::pow(std::abs(sine), s.epsilon1), sine);
      if (i == 0 || i == steps)
        height = i == 0 ? low : high;
      rings.push_back({sectionAt(s, height, inset), height * s.semi_axes.z()});
    }
    return rings;
  };
  std::vector<std::vector<Ring>> stretches = {side(-1.0, rim, 0.0)};
  const Ring outer = stretches[0].back();
  if (!s.isHollow()) {
    stretches.push_back({outer, {Section(), outer.z}});
    return stretches;
  }
  std::vector<Ring> inside = side(floorHeight(s), rim, s.wall);
  std::reverse(inside.begin(), inside.end());
  stretches.push_back({outer, inside.front()});
  stretches.push_back(inside);
  stretches.push_back({inside.back(), {Section(), inside.back().z}});
  return stretches;
}

Eigen::Vector3d onRing(const Ring& ring, double epsilon2, double angle) {
  const double x = std::cos(angle), y = std::sin(angle);
  const double larger = std::max(std::abs(x), std::abs(y)),
               smaller = std::min(std::abs(x), std::abs(y));
  const double norm =
      larger *
      std::pow(1.0 + std::pow(smaller / larger, 2.0 / epsilon2), 0.5 * epsilon2);
  return {ring.section.a * x / norm, ring.section.b * y / norm, ring.z};
}

void openResiduals(const Superquadric& s,
                   const UnitPoints& points,
                   kernels::Residual residual,
                   float* out) {
  const Meridian all_round(s, Eigen::Vector2d::UnitX());
  const double size = std::cbrt(s.semi_axes.prod());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d local = s.toLocal(points[i].cast<double>());
    double r = isRound(s) ? all_round.distance(local.head<2>().norm(), local.z())
                          : meridianDistance(s, local);
    if (residual == kernels::Residual::GAUGE)
      r /= size;
    else if (residual == kernels::Residual::SOLINA)
      r = std::pow(1.0 + r / size, 2) - 1.0;
    out[i] = static_cast<float>(r);
  }
}

AxialMoments filledMoments(const Superquadric& s) {
  return momentsBetween(s, -1.0, s.rimHeight(), 0.0);
}

AxialMoments hollowMoments(const Superquadric& s) {
  return s.isHollow() ? momentsBetween(s, floorHeight(s), s.rimHeight(), s.wall)
                      : AxialMoments();
}

} // namespace detail

bool Superquadric::inHollow(const Eigen::Vector3d& point) const {
  if (!isHollow())
    return false;
  const Eigen::Vector3d local = toLocal(point);
  const double height = local.z() / semi_axes.z();
  return height > detail::floorHeight(*this) && height < rimHeight() &&
         detail::contains(
             detail::sectionAt(*this, height, wall), epsilon2, local.x(), local.y());
}

} // namespace pcl_sq
