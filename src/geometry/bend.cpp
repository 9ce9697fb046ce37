// SPDX-License-Identifier: BSD-3-Clause
// Bending the z axis to a circle: x = R - (R - X) cos(Z / R), z = (R - X) sin(Z / R)
// with R = 1 / curvature and X towards the circle's centre (M23).
#include "geometry/bend.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief Unit vector of the own frame towards the circle's centre, for a positive
 * curvature. */
Eigen::Vector3d towards(const Superquadric& s) {
  if (s.bend_angle == 0.0) // all that fits make
    return Eigen::Vector3d::UnitX();
  return {std::cos(s.bend_angle), std::sin(s.bend_angle), 0.0};
}

/** \brief How far the section reaches along x and y at most. */
Eigen::Vector2d widest(const Superquadric& s) {
  return {s.semi_axes.x() * (1.0 + std::abs(s.kx)),
          s.semi_axes.y() * (1.0 + std::abs(s.ky))};
}

/** \brief How far a box around the section reaches in the circle's plane. */
double reachInPlane(const Superquadric& s) {
  return towards(s).head<2>().cwiseAbs().dot(widest(s));
}

/** \brief Height over a3 and the section's scale of a point of the meridian: points
 * (1 - |t|, t) of a line, scaled onto the superellipse. */
struct Latitude {
  double sine, cosine, height, scale;
};

Latitude latitude(const Superquadric& s, double t) {
  const double share = std::abs(t), rest = 1.0 - share;
  const double larger = std::max(share, rest), smaller = std::min(share, rest);
  const double power = std::pow(smaller / larger, 2.0 / s.epsilon1);
  const double norm = larger * std::pow(1.0 + power, 0.5 * s.epsilon1);
  const double small = std::sqrt(power / (1.0 + power)),
               large = 1.0 / std::sqrt(1.0 + power);
  return {std::copysign(share > rest ? large : small, t),
          share > rest ? small : large,
          t / norm,
          rest / norm};
}

/** \brief A point of the bent axis: its angle on the circle, how far it lies towards
 * the circle's centre, and how far along the straight axis. */
struct ArcPlace {
  double sine, cosine, inwards, along;
};

ArcPlace arcAt(const Superquadric& s, double z) {
  const double half_angle = 0.5 * s.bend * z;
  const double half = std::sin(half_angle);
  const double sine = 2.0 * half * std::cos(half_angle), versine = 2.0 * half * half;
  return {sine, 1.0 - versine, versine / s.bend, sine / s.bend};
}

/** \brief The place t of the meridian at a height over a3. */
double placeAt(const Superquadric& s, double height) {
  const double h = std::min(std::abs(height), 1.0);
  const double scale = std::pow(1.0 - std::pow(h, 2.0 / s.epsilon1), 0.5 * s.epsilon1);
  return std::copysign(h / (h + scale), height);
}

} // namespace

BentFrame bentFrame(const Superquadric& s, double z) {
  const Eigen::Vector3d d = towards(s), across(-d.y(), d.x(), 0.0);
  const ArcPlace arc = arcAt(s, z);
  const Eigen::Vector3d inwards = arc.cosine * d - arc.sine * Eigen::Vector3d::UnitZ();
  BentFrame f;
  f.middle = arc.inwards * d;
  f.middle.z() = arc.along;
  f.axes.col(0) = d.x() * inwards - d.y() * across;
  f.axes.col(1) = d.y() * inwards + d.x() * across;
  f.axes.col(2) = arc.sine * d + arc.cosine * Eigen::Vector3d::UnitZ();
  return f;
}

Eigen::Vector3d bent(const Superquadric& s, const Eigen::Vector3d& p) {
  if (!s.isBent())
    return p;
  const BentFrame f = bentFrame(s, p.z());
  return f.middle + f.axes.leftCols<2>() * p.head<2>();
}

Eigen::Vector3d unbent(const Superquadric& s, const Eigen::Vector3d& local) {
  if (!s.isBent())
    return local;
  const Eigen::Vector3d d = towards(s);
  const double x = d.dot(local), y = d.x() * local.y() - d.y() * local.x();
  const double ahead = 1.0 - s.bend * x, along = s.bend * local.z();
  const double radius = std::hypot(ahead, along); // over the circle's
  const double across =
      (2.0 * x - s.bend * (x * x + local.z() * local.z())) / (1.0 + radius);
  return {d.x() * across - d.y() * y,
          d.y() * across + d.x() * y,
          std::atan2(along, ahead) / s.bend};
}

double fibre(const Superquadric& s, const Eigen::Vector3d& p) {
  return s.isBent() ? std::max(1.0 - s.bend * towards(s).dot(p), 0.0) : 1.0;
}

Eigen::Vector3d bendVelocity(const Superquadric& s, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = towards(s);
  const double z = p.z(), angle = s.bend * z;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  double x_slope = 0.5 * z * z, z_slope = -angle * z * z / 3.0; // of the circle
  if (std::abs(angle) > 1e-3) {
    x_slope = (angle * sine - (1.0 - cosine)) / (s.bend * s.bend);
    z_slope = (angle * cosine - sine) / (s.bend * s.bend);
  }
  const double across = d.dot(p);
  return (x_slope - across * z * sine) * d +
         (z_slope - across * z * cosine) * Eigen::Vector3d::UnitZ();
}

Eigen::Vector3d bentHalfSizes(const Superquadric& s) {
  const Eigen::Vector3d d = towards(s);
  const double radius = 1.0 / std::abs(s.bend), angle = s.semi_axes.z() / radius;
  const double width = reachInPlane(s);
  const double end =
      radius -
      std::cos(angle) * (std::cos(angle) > 0.0 ? radius - width : radius + width);
  const double in_plane = std::max(width, end);
  const double beside = Eigen::Vector2d(d.y(), d.x()).cwiseAbs().dot(widest(s));
  return {std::abs(d.x()) * in_plane + std::abs(d.y()) * beside,
          std::abs(d.y()) * in_plane + std::abs(d.x()) * beside,
          (radius + width) * (angle < M_PI_2 ? std::sin(angle) : 1.0)};
}

const char* invalidBend(const Superquadric& s) {
  if (!std::isfinite(s.bend) || !std::isfinite(s.bend_angle))
    return "a bend is not finite";
  if (!s.isBent())
    return nullptr;
  if (s.isCut())
    return "a bent body has a rim or a wall, which is not supported";
  if (!(std::abs(s.bend) * s.semi_axes.z() <= Superquadric::MAX_BEND))
    return "a body is bent by more than 3 rad to either side and meets itself";
  if (!(std::abs(s.bend) * reachInPlane(s) <= Superquadric::MAX_FOLD))
    return "a body is bent so far that it folds: it is wider than the circle's radius";
  return nullptr;
}

struct BentSupport::Touching {
  Eigen::Vector2d n, size; ///< direction in the section, its semi-axes
  double u, v, reach;
};

BentSupport::BentSupport(const Superquadric& s, double low, double high)
    : s_(s), towards_(towards(s)), begin_(placeAt(s, low)), end_(placeAt(s, high)),
      step_((end_ - begin_) / SLICES) {
  for (int i = 0; i <= SLICES; ++i)
    slices_[std::size_t(i)] = at(begin_ + i * step_);
}

BentSupport::Slice BentSupport::at(double t) const {
  const Latitude l = latitude(s_, t);
  const ArcPlace arc = arcAt(s_, s_.semi_axes.z() * l.height);
  return {l.sine,
          l.cosine,
          l.height,
          l.scale,
          arc.sine,
          arc.cosine,
          arc.inwards,
          arc.along};
}

BentSupport::Touching BentSupport::touching(const Slice& c,
                                            const Eigen::Vector3d& n) const {
  const double e2 = std::min(s_.epsilon2, MAX_SECTION), p = 2.0 / (2.0 - e2);
  const Eigen::Vector3d &a = s_.semi_axes, &d = towards_;
  const double inwards = d.dot(n), across = d.x() * n.y() - d.y() * n.x();
  const double in_section = c.arc_cosine * inwards - c.arc_sine * n.z();
  Touching t;
  t.n = {in_section * d.x() - across * d.y(), in_section * d.y() + across * d.x()};
  t.size = {a.x() * (1.0 + s_.kx * c.height), a.y() * (1.0 + s_.ky * c.height)};
  t.u = std::abs(t.n.x()) * t.size.x();
  t.v = std::abs(t.n.y()) * t.size.y();
  double norm = 0.0;
  if (e2 == 1.0) // round: all that fits make
    norm = std::sqrt(t.u * t.u + t.v * t.v);
  else if (const double larger = std::max(t.u, t.v); larger > 0.0)
    norm = larger * std::pow(1.0 + std::pow(std::min(t.u, t.v) / larger, p), 1.0 / p);
  t.reach = c.inwards * inwards + c.along * n.z() + c.scale * norm;
  return t;
}

BentContact BentSupport::contact(const Eigen::Vector3d& n) const {
  constexpr int PRECISION_BITS = 12; // of the place; the reach is known to twice that
  int highest = 0;
  double most = touching(slices_[0], n).reach;
  for (int i = 1; i <= SLICES; ++i) {
    const double reach = touching(slices_[std::size_t(i)], n).reach;
    if (reach > most) {
      most = reach;
      highest = i;
    }
  }
  const double best = begin_ + highest * step_;
  const double top = boost::math::tools::brent_find_minima(
                         [&](double t) { return -touching(at(t), n).reach; },
                         std::max(best - step_, begin_),
                         std::min(best + step_, end_),
                         PRECISION_BITS)
                         .first;
  Slice c = at(top);
  Touching t = touching(c, n);
  if (!(t.reach > most)) {
    c = slices_[std::size_t(highest)];
    t = touching(c, n);
  }
  const double e2 = std::min(s_.epsilon2, MAX_SECTION), p = 2.0 / (2.0 - e2);
  BentContact contact;
  contact.reach = t.reach;
  contact.sine = c.sine;
  contact.cosine = c.cosine;
  const double larger = std::max(t.u, t.v);
  contact.shares = {0.5, 0.5};
  if (larger > 0.0) {
    const double x = std::pow(t.u / larger, p), y = std::pow(t.v / larger, p);
    contact.shares = Eigen::Vector2d(x, y) / (x + y);
  }
  const auto side = [&](int k) {
    return std::copysign(std::pow(contact.shares[k], 0.5 * e2), t.n[k]) * c.scale *
           t.size[k];
  };
  contact.unbent = {side(0), side(1), s_.semi_axes.z() * c.height};
  contact.at = bent(s_, contact.unbent);
  return contact;
}

int convexPieces(const Superquadric& s, double half_angle) {
  return std::max(1, int(std::ceil(std::abs(s.bend) * s.semi_axes.z() / half_angle)));
}

BentMoments bentMoments(const Superquadric& s) {
  const Eigen::Vector3d d = towards(s), f(-d.y(), d.x(), 0.0);
  BentMoments m;
  forEachSection(s, -1.0, 1.0, 0.0, [&](double z, double dz, const SectionMoments& c) {
    // second moments along the circle's plane and across it; the third ones are zero
    const double in_plane = d.x() * d.x() * c.xx + d.y() * d.y() * c.yy;
    const double across = d.y() * d.y() * c.xx + d.x() * d.x() * c.yy;
    const double mixed = d.x() * d.y() * (c.yy - c.xx);
    const BentFrame frame = bentFrame(s, z);
    const Eigen::Vector3d e = frame.axes * d, shift = in_plane * e + mixed * f;
    m.volume += dz * c.area;
    m.first += dz * (c.area * frame.middle - s.bend * shift);
    const Eigen::Matrix3d lever = frame.middle * shift.transpose(),
                          turned = e * f.transpose();
    m.second +=
        dz * (c.area * frame.middle * frame.middle.transpose() -
              s.bend * (lever + lever.transpose()) + in_plane * e * e.transpose() +
              across * f * f.transpose() + mixed * (turned + turned.transpose()));
  });
  return m;
}

} // namespace pcl_sq::detail
