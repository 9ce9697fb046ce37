// SPDX-License-Identifier: BSD-3-Clause
// Private. One vector of points: the gauge with its derivatives and the residuals, for
// any number of lanes. G is a nested p-norm, its derivatives for the exponents half an
// entropy (see gauge.h).
#pragma once

#include "kernels.h"
#include "simd.h"

namespace {

using namespace pcl_sq::kernels;

struct Vector {
  Float x, y, z;
};

inline Float dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/** \brief The shape's numbers spread over all lanes. */
struct Lanes {
  Float axes[3][3], offset[3], inverse_axis[3];
  Float q1, q2; ///< 2 / epsilon
  Float r1, r2; ///< epsilon / 2
  bool flat;    ///< whether feet are looked for along the axes
};

inline Lanes spread(const Shape& s) {
  Lanes l;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      l.axes[i][k] = all(s.axes[i][k]);
    l.offset[i] = all(s.offset[i]);
    l.inverse_axis[i] = all(s.inverse_axis[i]);
  }
  l.q1 = all(2.0F / s.epsilon1);
  l.q2 = all(2.0F / s.epsilon2);
  l.r1 = all(0.5F * s.epsilon1);
  l.r2 = all(0.5F * s.epsilon2);
  float least = s.inverse_axis[0], most = least;
  for (const float a : s.inverse_axis) {
    least = a < least ? a : least;
    most = a > most ? a : most;
  }
  l.flat = most > FLAT * least;
  return l;
}

/** \brief The shape whose gauge is the support function of \a s, in its frame. */
inline Lanes spreadDual(const Shape& s) {
  constexpr float SMALLEST = 1e-6F; // instead of an exponent of zero
  Shape dual = s;
  for (float& inverse_axis : dual.inverse_axis)
    inverse_axis = 1.0F / inverse_axis;
  dual.epsilon1 = 2.0F - s.epsilon1 > SMALLEST ? 2.0F - s.epsilon1 : SMALLEST;
  dual.epsilon2 = 2.0F - s.epsilon2 > SMALLEST ? 2.0F - s.epsilon2 : SMALLEST;
  return spread(dual);
}

inline Vector turned(const Lanes& l, Float x, Float y, Float z) {
  return {l.axes[0][0] * x + l.axes[0][1] * y + l.axes[0][2] * z,
          l.axes[1][0] * x + l.axes[1][1] * y + l.axes[1][2] * z,
          l.axes[2][0] * x + l.axes[2][1] * y + l.axes[2][2] * z};
}

inline Vector local(const Lanes& l, const Points& p, std::size_t i) {
  const Vector v = turned(l, load(p.x + i), load(p.y + i), load(p.z + i));
  return {v.x - l.offset[0], v.y - l.offset[1], v.z - l.offset[2]};
}

struct Norm {
  Float value;   ///< ln ||(exp(l0), exp(l1))||_q
  Float w0, w1;  ///< shares of the two terms
  Float entropy; ///< of the shares
};

/** \brief ln(1 + u) for u in [0, 1] to single precision: the series of 2 artanh(s) at
 * s = u / (2 + u), its last term fitted to what follows. */
inline Float logOnePlus(Float u) {
  const Float s = u * inverse(2.0F + u);
  const Float s2 = s * s;
  const Float s4 = s2 * s2;
  const Float p =
      ((0.197F * s2 + 2.0F / 9.0F) * s4 + (2.0F / 7.0F * s2 + 2.0F / 5.0F)) * s4 +
      (2.0F / 3.0F * s2 + 2.0F);
  return s * p;
}

inline Norm logNorm(Float l0, Float l1, Float q, Float inverse_q) {
  const Float larger = max(l0, l1);
  // below e^-30 the smaller term is made exactly zero: no float sum can see it, and the
  // products of the rows stay clear of slow denormal numbers
  const Float qd = max(q * (min(l0, l1) - larger), all(-30.0F));
  const Float u = exp(qd) - 9.3576230e-14F;
  const Float w_larger = inverse(1.0F + u);
  const Float w_smaller = u * w_larger;
  const Float log_sum = logOnePlus(u);
  return {larger + log_sum * inverse_q,
          select(l0 >= l1, w_larger, w_smaller),
          select(l0 >= l1, w_smaller, w_larger),
          log_sum - qd * w_smaller};
}

/** \brief ln G with all its derivatives. */
struct Gauge {
  Float value;
  Float a1, a2, a3; ///< -d ln G / d ln a
  Float e1, e2;     ///< d ln G / d epsilon
  Vector gradient;  ///< d ln G / d y
};

/** \brief share / coordinate without dividing by zero: there the share is zero too. */
inline Float shareOver(Float share, Float coordinate) {
  const Float size = max(abs(coordinate), all(1e-9F));
  return withSign(share, coordinate) * inverse(size);
}

inline Gauge gauge(const Lanes& l, const Vector& y) {
  const Float tiny = all(1e-12F);
  const Norm inner = logNorm(log(max(abs(y.x) * l.inverse_axis[0], tiny)),
                             log(max(abs(y.y) * l.inverse_axis[1], tiny)),
                             l.q2,
                             l.r2);
  const Norm outer =
      logNorm(inner.value, log(max(abs(y.z) * l.inverse_axis[2], tiny)), l.q1, l.r1);
  Gauge g;
  g.value = outer.value;
  g.a1 = outer.w0 * inner.w0;
  g.a2 = outer.w0 * inner.w1;
  g.a3 = outer.w1;
  g.e1 = 0.5F * outer.entropy;
  g.e2 = 0.5F * outer.w0 * inner.entropy;
  g.gradient = {shareOver(g.a1, y.x), shareOver(g.a2, y.y), shareOver(g.a3, y.z)};
  return g;
}

inline Float length(const Vector& v) {
  return sqrt(dot(v, v) + 1e-30F);
}

/** \brief Residual and its derivatives at one vector of points. */
struct Row {
  Float residual;
  Float factor;   ///< d residual / d ln G: multiplies the gauge's derivatives
  Vector spatial; ///< d residual / d y
  Vector at;      ///< where the derivatives are taken, for the rotation's
  Gauge gauge;
};

template <Residual KIND>
inline Row row(const Lanes& l, const Vector& y) {
  static_assert(KIND != Residual::FOOT_POINT, "has two stages");
  Row r;
  r.gauge = gauge(l, y);
  r.at = y;
  const Vector& g = r.gauge.gradient;
  if (KIND == Residual::RADIAL) {
    const Float size = length(y);
    const Float inverse_gauge = exp(-r.gauge.value);
    const Float outside = 1.0F - inverse_gauge;
    r.residual = size * outside;
    r.factor = size * inverse_gauge;
    const Float along = outside * inverse(size);
    r.spatial = {r.factor * g.x + along * y.x,
                 r.factor * g.y + along * y.y,
                 r.factor * g.z + along * y.z};
  } else if (KIND == Residual::GAUGE || KIND == Residual::SOLINA) {
    const Float power = KIND == Residual::GAUGE ? 1.0F + Float{} : 2.0F + Float{};
    const Float value = exp(power * min(r.gauge.value, all(40.0F)));
    r.residual = value - 1.0F;
    r.factor = power * value;
    r.spatial = {r.factor * g.x, r.factor * g.y, r.factor * g.z};
  } else {
    r.factor = inverse(max(length(g), all(1e-18F)));
    r.residual = (1.0F - exp(-r.gauge.value)) * r.factor;
    r.spatial = {r.factor * g.x, r.factor * g.y, r.factor * g.z};
  }
  return r;
}

/** \brief Tangent plane at the radial projection, and the foot of the perpendicular
 * (M4). */
struct Foot {
  Vector at;
  Float outside; ///< 1 - 1/G
};

/** \brief Where the surface is met along one of the axes. */
struct AlongAxis {
  Vector at;
  Float away; ///< from the point
};

/** \brief The nearest of these places of a straight body.
 * \param[in] x_stretch lengths along x are longer by that, for the body is tapered */
inline AlongAxis
nearestAlongAxes(const Lanes& l, const Vector& y, Float x_stretch, Float y_stretch) {
  constexpr float LEAST = 1e-12F, FAR = 1e12F;
  const auto power = [](Float logarithm, Float q) {
    return exp(min(max(q * logarithm, all(-30.0F)), all(20.0F)));
  };
  const auto logOf = [](Float x) { return log(max(x, all(LEAST))); };
  const Float lx = logOf(abs(y.x) * l.inverse_axis[0]);
  const Float ly = logOf(abs(y.y) * l.inverse_axis[1]);
  const Float lz = logOf(abs(y.z) * l.inverse_axis[2]);
  const Float x = power(lx, l.q2), y_term = power(ly, l.q2), z = power(lz, l.q1);
  const Float section = power(logOf(x + y_term), l.r2 * l.q1); // of x and y in F
  const Float left = // for x and y at that height
      select(z < all(1.0F), power(logOf(1.0F - z), l.r1 * l.q2), all(0.0F));
  // height of the surface along an axis whose term has this left, and how far it is
  const auto along = [&](Float term, Float r, int k, Float coordinate, Float& off) {
    const Float height = power(logOf(term), r) * inverse(l.inverse_axis[k]);
    off = select(term > all(LEAST), abs(height - abs(coordinate)), all(FAR));
    return withSign(height, coordinate);
  };
  Float dx, dy, dz;
  const Float sx = along(left - y_term, l.r2, 0, y.x, dx);
  const Float sy = along(left - x, l.r2, 1, y.y, dy);
  const Float sz = along(1.0F - section, l.r1, 2, y.z, dz);
  dx = dx * x_stretch;
  dy = dy * y_stretch;
  const Float best = min(dx, min(dy, dz));
  return {{select(dx <= best, sx, y.x),
           select((dx > best) & (dy <= best), sy, y.y),
           select((dx > best) & (dy > best), sz, y.z)},
          best};
}

template <typename Mask>
inline Vector choose(Mask which, const Vector& a, const Vector& b) {
  return {select(which, a.x, b.x), select(which, a.y, b.y), select(which, a.z, b.z)};
}

inline Foot footOnPlane(const Lanes& l, const Vector& y) {
  const Gauge gauge_y = gauge(l, y);
  const Vector& g = gauge_y.gradient;
  const Float outside = 1.0F - exp(-gauge_y.value);
  // (y - y/G).n = outside * y.g / |g| and y.g = 1 (homogeneity)
  const Float step = outside * inverse(max(dot(g, g), all(1e-30F)));
  const Vector at = {y.x - step * g.x, y.y - step * g.y, y.z - step * g.z};
  if (!l.flat)
    return {at, outside};
  const AlongAxis near = nearestAlongAxes(l, y, all(1.0F), all(1.0F));
  return {choose(near.away < abs(step) * length(g), near.at, at), outside};
}

/** \brief From the plane back onto the surface along the radius. */
inline Row footRow(const Lanes& l, const Vector& y, const Foot& foot) {
  Row r;
  r.gauge = gauge(l, foot.at);
  const Float scale = exp(-r.gauge.value);
  r.at = {foot.at.x * scale, foot.at.y * scale, foot.at.z * scale};
  const Vector& f = r.gauge.gradient; // degree -1: at the surface gradient / scale
  const Float radial = length(y) * abs(foot.outside);
  const Vector off = {y.x - r.at.x, y.y - r.at.y, y.z - r.at.z};
  r.residual = withSign(min(length(off), radial), foot.outside);
  const Float inverse_f = inverse(max(length(f), all(1e-18F)));
  r.factor = scale * inverse_f;
  r.spatial = {f.x * inverse_f, f.y * inverse_f, f.z * inverse_f};
  return r;
}

/** \brief The row of a deformed body's foot, which has its own gradient.
 * \param[in] off from the radial projection to the point \param[in] sign of the side */
template <typename Place>
inline Row
deformedRow(const Place& foot, const Vector& y, const Vector& off, Float sign) {
  Row r;
  r.gauge = foot.gauge;
  r.at = foot.at;
  const Vector rest = {y.x - r.at.x, y.y - r.at.y, y.z - r.at.z};
  r.residual = withSign(min(length(rest), length(off)), sign);
  r.factor = inverse(max(length(foot.gradient), all(1e-18F)));
  r.spatial = {foot.gradient.x * r.factor,
               foot.gradient.y * r.factor,
               foot.gradient.z * r.factor};
  return r;
}

} // namespace
