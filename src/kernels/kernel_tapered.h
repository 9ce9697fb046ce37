// SPDX-License-Identifier: BSD-3-Clause
// Private. One vector of points or planes of a tapered body: distance to the foot point
// and support function, with their derivatives for all thirteen parameters.
#pragma once

#include "kernel_rows.h"

namespace {

struct Taper {
  Float kx, ky;
};

/** \brief Growth of the section at a height over a3, never below that of the largest
 * taper (Superquadric::MAX_TAPER). */
inline Float growth(Float k, Float height) {
  constexpr float LEAST = 0.05F;
  return max(1.0F + k * height, all(LEAST));
}

/** \brief The radial projection before tapering, tapered, and d ln G / d y there. */
struct TaperedPlace {
  Gauge gauge; ///< of the straight body at the point
  Vector at, gradient;
  Float height;   ///< z / a3
  Float x_growth; ///< 1 / growth of the section
  Float y_growth;
  Float leaning; ///< -d ln G / d height by the taper alone
};

inline TaperedPlace taperedPlace(const Lanes& l, const Taper& t, const Vector& y) {
  TaperedPlace p;
  const Float height = y.z * l.inverse_axis[2];
  const Vector straight = {
      y.x * inverse(growth(t.kx, height)), y.y * inverse(growth(t.ky, height)), y.z};
  p.gauge = gauge(l, straight);
  const Float scale = exp(-p.gauge.value);
  p.height = height * scale;
  const Float fx = growth(t.kx, p.height), fy = growth(t.ky, p.height);
  p.x_growth = inverse(fx);
  p.y_growth = inverse(fy);
  p.at = {straight.x * scale * fx, straight.y * scale * fy, y.z * scale};
  // the shares stay the same along a ray of the straight body
  p.leaning = p.gauge.a1 * t.kx * p.x_growth + p.gauge.a2 * t.ky * p.y_growth;
  p.gradient = {shareOver(p.gauge.a1, p.at.x),
                shareOver(p.gauge.a2, p.at.y),
                shareOver(p.gauge.a3, p.at.z) - p.leaning * l.inverse_axis[2]};
  return p;
}

/** \brief The place met along an axis if that is nearer than \a step, else \a plane. */
inline Vector nearerAlongAxes(
    const Lanes& l, const Taper& t, const Vector& y, const Vector& plane, Float step) {
  const Float height = y.z * l.inverse_axis[2];
  const Float fx = growth(t.kx, height), fy = growth(t.ky, height);
  const AlongAxis near =
      nearestAlongAxes(l, {y.x * inverse(fx), y.y * inverse(fy), y.z}, fx, fy);
  const Vector at = {near.at.x * fx, near.at.y * fy, near.at.z};
  return choose(near.away < step, at, plane);
}

/** \brief Distance to the foot point on the tangent plane at the radial projection;
 * stores the taper's two derivatives. */
template <int R>
inline Row taperedRow(const Lanes& l,
                      const Taper& t,
                      const Vector& y,
                      float (&rows)[R][BLOCK],
                      std::size_t i) {
  static_assert(R == TAPERED_ROWS, "has rows for the taper");
  const TaperedPlace first = taperedPlace(l, t, y);
  const Vector off = {y.x - first.at.x, y.y - first.at.y, y.z - first.at.z};
  const Float step = dot(off, first.gradient) *
                     inverse(max(dot(first.gradient, first.gradient), all(1e-30F)));
  Vector plane = {y.x - step * first.gradient.x,
                  y.y - step * first.gradient.y,
                  y.z - step * first.gradient.z};
  if (l.flat)
    plane = nearerAlongAxes(l, t, y, plane, abs(step) * length(first.gradient));
  const TaperedPlace foot = taperedPlace(l, t, plane);
  Row r = deformedRow(foot, y, off, first.gauge.value);
  r.gauge.a3 -= foot.height * foot.leaning; // a3 stretches the taper too
  store(rows[11] + i, -r.factor * foot.gauge.a1 * foot.height * foot.x_growth);
  store(rows[12] + i, -r.factor * foot.gauge.a2 * foot.height * foot.y_growth);
  return r;
}

/** \brief Support function of a tapered body. The body is cut at heights z = a3 t, its
 * section scaled by s(t) = (1 - |t|^(2/e1))^(e1/2) and the taper, so that
 * h(n) = max over t of n_z a3 t + s(t) |(n_x a1 f_x, n_y a2 f_y)|_p, p = 2 / (2 - e2),
 * the dual norm of the section's. A table of slices finds the highest peak: a tapered
 * body need not be convex. The golden section finds its top. */
class TaperedSupport {
public:
  explicit TaperedSupport(const Shape& shape) {
    constexpr float MOST_PINCHED = 1.98F; // the dual of e2 = 2 is the maximum norm
    const float e2 = shape.epsilon2 < MOST_PINCHED ? shape.epsilon2 : MOST_PINCHED;
    lanes_ = spread(shape);
    taper_ = {all(shape.kx), all(shape.ky)};
    for (int k = 0; k < 3; ++k)
      axis_[k] = all(1.0F / shape.inverse_axis[k]);
    half_e2_ = all(0.5F * e2);
    inverse_e1_ = all(1.0F / shape.epsilon1);
    p_ = all(2.0F / (2.0F - e2));
    inverse_p_ = all(0.5F * (2.0F - e2));
    for (int k = 0; k <= SLICES; ++k) {
      const float angle = 3.14159265F * (float(k) / SLICES - 0.5F);
      const float size =
          __builtin_powf(__builtin_fabsf(__builtin_sinf(angle)), shape.epsilon1);
      heights_[k] = k == SLICES / 2 ? 0.0F : __builtin_copysignf(size, angle);
    }
    heights_[0] = -1.0F;
    heights_[SLICES] = 1.0F;
    for (int k = 0; k <= SLICES; k += LANES)
      store(scales_ + k, scaleOf(logLeft(logHeight(load(heights_ + k)))));
  }

  /** \brief The rows of a vector of planes: derivatives and residual. */
  void row(const Planes& planes,
           std::size_t i,
           float (&rows)[TAPERED_ROWS][BLOCK],
           std::size_t p) const {
    const Vector n =
        turned(lanes_, load(planes.x + i), load(planes.y + i), load(planes.z + i));
    const Slice c = farthest(n);
    // where it touches, by the shares in the section's dual norm
    const Float share_x = log(max(c.section.w0, all(1e-30F)));
    const Float share_y = log(max(c.section.w1, all(1e-30F)));
    const Float along_x = c.scale * c.u * exp(half_e2_ * share_x);
    const Float along_y = c.scale * c.v * exp(half_e2_ * share_y);
    const Float along_z = n.z * axis_[2] * c.height;
    const Vector touching = {along_x * inverse(positive(n.x)),
                             along_y * inverse(positive(n.y)),
                             axis_[2] * c.height};
    const Float beyond =
        c.reach + dot(n, {lanes_.offset[0], lanes_.offset[1], lanes_.offset[2]}) -
        load(planes.offset + i);
    const Float w =
        select(beyond > load(planes.least + i), load(planes.weight + i), Float{});
    const Float grown_x = along_x * inverse(c.fx), grown_y = along_y * inverse(c.fy);
    const Float growing = grown_x * taper_.kx + grown_y * taper_.ky;
    store(rows[0] + p, w * n.x);
    store(rows[1] + p, w * n.y);
    store(rows[2] + p, w * n.z);
    store(rows[3] + p, w * (touching.y * n.z - touching.z * n.y));
    store(rows[4] + p, w * (touching.z * n.x - touching.x * n.z));
    store(rows[5] + p, w * (touching.x * n.y - touching.y * n.x));
    store(rows[6] + p, w * along_x);
    store(rows[7] + p, w * along_y);
    store(rows[8] + p, w * along_z);
    // angles are held: t = sin^e1, s = cos^e1 of the latitude
    store(rows[9] + p,
          w * ((along_z + growing * c.height) * c.log_height * inverse_e1_ +
               (along_x + along_y) * 0.5F * c.log_left));
    store(rows[10] + p, w * 0.5F * (along_x * share_x + along_y * share_y));
    store(rows[11] + p, w * grown_x * c.height);
    store(rows[12] + p, w * grown_y * c.height);
    store(rows[13] + p, w * beyond);
    store(rows[14] + p, Float{});
  }

private:
  static constexpr int SLICES = 16;
  /** \brief Golden sections of two slices: the height is then known to a hundredth of
   * them, and how far the body reaches to the square of that. */
  static constexpr int REFINEMENTS = 10;

  struct Slice {
    Float height, log_height; ///< z / a3
    Float log_left;           ///< ln(1 - |t|^(2/e1))
    Float scale;              ///< s(t)
    Float fx, fy;             ///< growth
    Float u, v;               ///< |n_x| a1 f_x, |n_y| a2 f_y
    Norm section;             ///< logarithm of its dual norm
    Float reach;
  };

  /** \brief Keeps the sign, and away from zero. */
  static Float positive(Float x) { return withSign(max(abs(x), all(1e-12F)), x); }

  static Float logHeight(Float height) { return log(max(abs(height), all(1e-12F))); }
  Float logLeft(Float log_height) const {
    return log(max(1.0F - exp(max(lanes_.q1 * log_height, all(-80.0F))), all(1e-30F)));
  }
  Float scaleOf(Float log_left) const { return exp(lanes_.r1 * log_left); }

  Slice at(const Vector& n, Float height) const {
    Slice c;
    c.log_height = logHeight(height);
    c.log_left = logLeft(c.log_height);
    setReach(n, height, scaleOf(c.log_left), c);
    return c;
  }

  void setReach(const Vector& n, Float height, Float scale, Slice& c) const {
    c.height = height;
    c.scale = scale;
    c.fx = growth(taper_.kx, height);
    c.fy = growth(taper_.ky, height);
    c.u = abs(n.x) * axis_[0] * c.fx;
    c.v = abs(n.y) * axis_[1] * c.fy;
    c.section =
        logNorm(log(max(c.u, all(1e-12F))), log(max(c.v, all(1e-12F))), p_, inverse_p_);
    c.reach = n.z * axis_[2] * height + c.scale * exp(c.section.value);
  }

  /** \brief How far one of the table's slices reaches. */
  Float reachOf(const Vector& n, int k) const {
    Slice c;
    setReach(n, all(heights_[k]), all(scales_[k]), c);
    return c.reach;
  }

  Slice farthest(const Vector& n) const {
    Float low = all(heights_[0]), high = all(heights_[1]), best = low;
    Float most = reachOf(n, 0);
    for (int k = 1; k <= SLICES; ++k) {
      const Float height = all(heights_[k]), reach = reachOf(n, k);
      const auto better = reach > most;
      most = select(better, reach, most);
      best = select(better, height, best);
      low = select(better, all(heights_[k - 1]), low);
      high = select(better, all(heights_[k < SLICES ? k + 1 : k]), high);
    }
    constexpr float GOLDEN = 0.618034F;
    Float left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
    Float at_left = at(n, left).reach, at_right = at(n, right).reach;
    for (int i = 0; i < REFINEMENTS; ++i) {
      const auto lower = at_left > at_right; // the top lies below the right place
      low = select(lower, low, left);
      high = select(lower, right, high);
      const Float next =
          select(lower, high - GOLDEN * (high - low), low + GOLDEN * (high - low));
      const Float at_next = at(n, next).reach;
      const Float kept = select(lower, left, right);
      const Float at_kept = select(lower, at_left, at_right);
      left = select(lower, next, kept);
      right = select(lower, kept, next);
      at_left = select(lower, at_next, at_kept);
      at_right = select(lower, at_kept, at_next);
    }
    const Float middle = 0.5F * (low + high);
    return at(n, select(at(n, middle).reach > most, middle, best));
  }

  Lanes lanes_;
  Taper taper_;
  Float axis_[3], half_e2_, inverse_e1_, p_, inverse_p_;
  alignas(64) float heights_[SLICES + LANES] = {};
  alignas(64) float scales_[SLICES + LANES];
};

} // namespace
