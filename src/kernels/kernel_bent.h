// SPDX-License-Identifier: BSD-3-Clause
// Private. Distances of points to a solid of e2 = 1 whose z axis is bent to a circle
// towards its x axis, with the derivatives (M23, M24).
#pragma once

#include "kernel_sums.h"

namespace {

/** \brief Angle of a vector of the plane, in (-pi, pi] (Cephes' constants). */
inline Float angleOf(Float x, Float y) {
  const Float ax = abs(x), ay = abs(y);
  const Float ratio = min(ax, ay) * inverse(max(max(ax, ay), all(1e-30F)));
  const auto large = ratio > all(0.41421356F); // tan(pi / 8)
  const Float t = select(large, (ratio - 1.0F) * inverse(ratio + 1.0F), ratio);
  const Float t2 = t * t;
  const Float p =
      ((8.05374449538e-2F * t2 - 1.38776856032e-1F) * t2 + 1.99777106478e-1F) * t2 -
      3.33329491539e-1F;
  Float angle = p * t2 * t + t + select(large, all(0.78539816F), all(0.0F));
  angle = select(ay > ax, 1.57079633F - angle, angle);
  angle = select(x < all(0.0F), 3.14159265F - angle, angle);
  return withSign(angle, y);
}

/** \brief Sine, and one less the cosine. */
struct Turn {
  Float sine, versine;
};

/** \brief Of an angle in [-pi, pi]: those of its quarter (Cephes' constants), doubled
 * twice. */
inline Turn turnBy(Float angle) {
  const Float q = 0.25F * angle, q2 = q * q;
  const Float sine =
      ((-1.9515295891e-4F * q2 + 8.3321608736e-3F) * q2 - 1.6666654611e-1F) * q2 * q +
      q;
  const Float versine =
      0.5F * q2 - ((2.443315711809948e-5F * q2 - 1.388731625493765e-3F) * q2 +
                   4.166664568298827e-2F) *
                      q2 * q2;
  const Float half = 2.0F * sine * (1.0F - versine); // of half the angle
  const Float half_cosine = 1.0F - 2.0F * sine * sine;
  return {2.0F * half * half_cosine, 2.0F * half * half};
}

/** \brief The circle to which the axis is bent. */
struct Circle {
  Float bend, radius;
};

inline Vector unbent(const Circle& c, const Vector& y) {
  const Float ahead = 1.0F - c.bend * y.x, along = c.bend * y.z;
  const Float over = sqrt(ahead * ahead + along * along);
  return {(2.0F * y.x - c.bend * (y.x * y.x + y.z * y.z)) * inverse(1.0F + over),
          y.y,
          angleOf(ahead, along) * c.radius};
}

/** \brief A place of the bent body's surface, and d ln G / d y there. */
struct BentPlace {
  Gauge gauge;     ///< of the straight body
  Vector straight; ///< before bending
  Vector at, gradient;
  Turn turn;
};

/** \brief The radial projection of a place before bending, bent. */
inline BentPlace bentPlace(const Lanes& l, const Circle& c, const Vector& y) {
  BentPlace p;
  const Vector u = unbent(c, y);
  p.gauge = gauge(l, u);
  const Float scale = exp(-p.gauge.value);
  p.straight = {u.x * scale, u.y * scale, u.z * scale};
  const Float most = all(3.14159265F);
  p.turn = turnBy(min(max(c.bend * p.straight.z, -most), most));
  const Float sine = p.turn.sine, cosine = 1.0F - p.turn.versine;
  p.at = {p.turn.versine * c.radius + cosine * p.straight.x,
          p.straight.y,
          sine * c.radius - sine * p.straight.x};
  const Float longer = max(1.0F - c.bend * p.straight.x, all(1e-9F)); // fibres are
  const Float gx = shareOver(p.gauge.a1, p.straight.x),
              gz = shareOver(p.gauge.a3, p.straight.z) * inverse(longer);
  p.gradient = {cosine * gx + sine * gz,
                shareOver(p.gauge.a2, p.straight.y),
                cosine * gz - sine * gx};
  return p;
}

/** \brief How fast a place moves as the curvature grows, along the gradient. */
inline Float bendingAlong(const Circle& c, const BentPlace& p) {
  const Float z = p.straight.z, z2 = z * z, angle = c.bend * z, a2 = angle * angle;
  const Float sine = p.turn.sine, cosine = 1.0F - p.turn.versine;
  const auto large = abs(angle) > all(0.1F); // else the differences are series
  const Float r2 = c.radius * c.radius;
  const Float x_slope =
      select(large, (angle * sine - p.turn.versine) * r2, z2 * (0.5F - 0.125F * a2));
  const Float z_slope = select(large,
                               (angle * cosine - sine) * r2,
                               angle * z2 * (a2 * (1.0F / 30.0F) - 1.0F / 3.0F));
  const Float across = p.straight.x * z;
  return p.gradient.x * (x_slope - across * sine) +
         p.gradient.z * (z_slope - across * cosine);
}

/** \brief Distance to the foot point, as that of a tapered body. \param[out] foot
 * \return with the curvature's derivative in the place of e2's, over the factor */
inline Row bentRow(const Lanes& l, const Circle& c, const Vector& y) {
  const BentPlace first = bentPlace(l, c, y);
  const Vector off = {y.x - first.at.x, y.y - first.at.y, y.z - first.at.z};
  const Vector& g = first.gradient;
  const Float step = dot(off, g) * inverse(max(dot(g, g), all(1e-30F)));
  const BentPlace foot =
      bentPlace(l, c, {y.x - step * g.x, y.y - step * g.y, y.z - step * g.z});
  Row r = deformedRow(foot, y, off, first.gauge.value);
  r.gauge.e2 = -bendingAlong(c, foot);
  return r;
}

template <bool ROBUST>
void bentSums(
    const Points& points, const Shape& shape, float bend, const Mixture& m, Sums& out) {
  alignas(64) float rows[ROWS][BLOCK];
  const Lanes l = spread(shape);
  const Circle circle = {all(bend), all(1.0F / bend)};
  WeightedSums<ROWS, PARAMETERS, ROBUST, true> sums(m, out);
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    for (std::size_t p = 0; p < size; p += LANES) {
      const Row r = bentRow(l, circle, local(l, points, begin + p));
      store(rows[PARAMETERS] + p, r.residual);
      storeDerivatives(r, rows, p);
    }
    sums.add(points, begin, size, rows);
  }
  sums.end();
}

inline void bentEquations(
    const Points& points, const Shape& shape, float bend, const Mixture& m, Sums& out) {
  if (m.outlier > 0.0F)
    bentSums<true>(points, shape, bend, m, out);
  else
    bentSums<false>(points, shape, bend, m, out);
}

inline void
bentResiduals(const Points& points, const Shape& shape, float bend, float* out) {
  alignas(64) float rest[LANES];
  const Lanes l = spread(shape);
  const Circle circle = {all(bend), all(1.0F / bend)};
  for (std::size_t i = 0; i < points.count; i += LANES) {
    store(rest, bentRow(l, circle, local(l, points, i)).residual);
    const std::size_t left = points.count - i;
    __builtin_memcpy(out + i, rest, (left < LANES ? left : LANES) * sizeof(float));
  }
}

} // namespace
