// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/open_body.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace detail {

double latitudeOf(const Superquadric& s, double height) {
  const double sine = std::pow(std::min(std::abs(height), 1.0), 1.0 / s.epsilon1);
  return std::copysign(std::asin(sine), height);
}

Superquadric withRimNearTop(const Superquadric& s) {
  constexpr double SHARP = 0.1, SAME = 0.002;
  if (!s.isCut() || s.isBent() || s.epsilon1 > SHARP)
    return s;
  // the height at which the section is narrower by SAME
  const double top =
      std::pow(1.0 - std::pow(1.0 - SAME, 2.0 / s.epsilon1), 0.5 * s.epsilon1);
  if (s.rim >= top)
    return s;
  // bottom, rim and walls stay where they are
  Superquadric same = s;
  const double longer = (1.0 + s.rim) / (1.0 + top);
  same.rim = top;
  same.semi_axes.z() *= longer;
  same.center += (same.semi_axes.z() - s.semi_axes.z()) * s.rotation.col(2);
  const auto widen = [longer](double& a, double& k) {
    const double slope = a * k * longer;
    a = a * (1.0 - k) + slope;
    k = slope / a;
  };
  widen(same.semi_axes.x(), same.kx);
  widen(same.semi_axes.y(), same.ky);
  return same;
}

void forEachSection(
    const Superquadric& s,
    double low,
    double high,
    double inset,
    const std::function<void(double, double, const SectionMoments&)>& use) {
  // area of a superellipse of unit semi-axes, and the integral of x^2 over it
  const double e2 = s.epsilon2;
  const double area = e2 * std::pow(std::tgamma(0.5 * e2), 2) / std::tgamma(e2);
  const double second = e2 * e2 * std::tgamma(1.5 * e2) * std::tgamma(0.5 * e2) /
                        std::tgamma(2.0 * e2 + 1.0);
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
        use(z * a3,
            weight * 0.5 * (z1 - z0) * a3,
            {area * c.a * c.b,
             second * c.a * c.a * c.a * c.b,
             second * c.a * c.b * c.b * c.b});
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
}

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

namespace {

AxialMoments
momentsBetween(const Superquadric& s, double low, double high, double inset) {
  AxialMoments m;
  const auto add = [&m](double z, double dz, const SectionMoments& c) {
    m.volume += dz * c.area;
    m.z += dz * c.area * z;
    m.zz += dz * c.area * z * z;
    m.xx += dz * c.xx;
    m.yy += dz * c.yy;
  };
  forEachSection(s, low, high, inset, add);
  return m;
}

} // namespace

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
