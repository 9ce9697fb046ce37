// SPDX-License-Identifier: BSD-3-Clause
// Private. The loops themselves, written once for any number of lanes and included by
// one file per instruction set, which defines PCL_SQ_LANES. See algorithm notes in
// gauge.h: G is a nested p-norm, its derivatives for the exponents half an entropy.
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
  return l;
}

inline Vector local(const Lanes& l, const Points& p, std::size_t i) {
  const Float x = load(p.x + i), y = load(p.y + i), z = load(p.z + i);
  return {l.axes[0][0] * x + l.axes[0][1] * y + l.axes[0][2] * z - l.offset[0],
          l.axes[1][0] * x + l.axes[1][1] * y + l.axes[1][2] * z - l.offset[1],
          l.axes[2][0] * x + l.axes[2][1] * y + l.axes[2][2] * z - l.offset[2]};
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

/** \brief Tangent plane at the radial projection, and the foot of the perpendicular. */
struct Foot {
  Vector at;
  Float outside; ///< 1 - 1/G
};

inline Foot footOnPlane(const Lanes& l, const Vector& y) {
  const Gauge gauge_y = gauge(l, y);
  const Vector& g = gauge_y.gradient;
  const Float outside = 1.0F - exp(-gauge_y.value);
  // (y - y/G).n = outside * y.g / |g| and y.g = 1 (homogeneity)
  const Float step = outside * inverse(max(dot(g, g), all(1e-30F)));
  return {{y.x - step * g.x, y.y - step * g.y, y.z - step * g.z}, outside};
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

/** \brief Feet of a block of points. The loop of its own is short enough for the
 * processor to work on several vectors at once: the chains of operations are long. */
inline void footBlock(const Lanes& l,
                      const Points& points,
                      std::size_t begin,
                      float (&feet)[4][BLOCK]) {
  const std::size_t rest = points.count - begin;
  const std::size_t size = rest < BLOCK ? rest : BLOCK;
  for (std::size_t p = 0; p < size; p += LANES) {
    const Foot foot = footOnPlane(l, local(l, points, begin + p));
    store(feet[0] + p, foot.at.x);
    store(feet[1] + p, foot.at.y);
    store(feet[2] + p, foot.at.z);
    store(feet[3] + p, foot.outside);
  }
}

inline Foot loadFoot(const float (&feet)[4][BLOCK], std::size_t p) {
  return {{load(feet[0] + p), load(feet[1] + p), load(feet[2] + p)}, load(feet[3] + p)};
}

/** \brief The residual alone, in as few operations as the kind allows. */
template <Residual KIND>
inline Float residual(const Lanes& l, const Vector& y) {
  if constexpr (KIND == Residual::FOOT_POINT)
    return footRow(l, y, footOnPlane(l, y)).residual;
  else
    return row<KIND>(l, y).residual;
}

/** \brief The Jacobian's columns of one vector of points, see PARAMETERS. */
inline void storeDerivatives(const Row& r, float (&rows)[ROWS][BLOCK], std::size_t p) {
  const Vector& g = r.spatial;
  store(rows[0] + p, -g.x);
  store(rows[1] + p, -g.y);
  store(rows[2] + p, -g.z);
  store(rows[3] + p, g.y * r.at.z - g.z * r.at.y);
  store(rows[4] + p, g.z * r.at.x - g.x * r.at.z);
  store(rows[5] + p, g.x * r.at.y - g.y * r.at.x);
  store(rows[6] + p, -r.factor * r.gauge.a1);
  store(rows[7] + p, -r.factor * r.gauge.a2);
  store(rows[8] + p, -r.factor * r.gauge.a3);
  store(rows[9] + p, r.factor * r.gauge.e1);
  store(rows[10] + p, r.factor * r.gauge.e2);
}

/** \brief Share and cost of a squared residual in the mixture. */
struct Weight {
  Float share, cost;
};

template <bool ROBUST>
inline Weight weight(Float square, Float s, Float c, Float inverse_s, Float log_full) {
  if (!ROBUST)
    return {all(1.0F), square};
  const Float e = exp(-s * square);
  const Float total = e + c;
  return {e * inverse(total), (log_full - log(total)) * inverse_s};
}

/** \brief Adds the products of one block's rows, kept as sums per lane. */
inline void addProducts(const float (&rows)[ROWS][BLOCK], float (*lanes)[LANES]) {
  static_assert(ROWS % 3 == 0, "tiles of three rows");
  for (int i = 0; i < ROWS; i += 3)
    for (int j = i; j < ROWS; j += 3) {
      Float s[9];
      for (int k = 0; k < 9; ++k)
        s[k] = load(lanes[k]);
      for (std::size_t p = 0; p < BLOCK; p += LANES) {
        const Float a0 = load(rows[i] + p), a1 = load(rows[i + 1] + p),
                    a2 = load(rows[i + 2] + p);
        const Float b0 = load(rows[j] + p), b1 = load(rows[j + 1] + p),
                    b2 = load(rows[j + 2] + p);
        s[0] += a0 * b0;
        s[1] += a0 * b1;
        s[2] += a0 * b2;
        s[3] += a1 * b0;
        s[4] += a1 * b1;
        s[5] += a1 * b2;
        s[6] += a2 * b0;
        s[7] += a2 * b1;
        s[8] += a2 * b2;
      }
      for (int k = 0; k < 9; ++k)
        store(lanes[k], s[k]);
      lanes += 9;
    }
}

constexpr int TILES = (ROWS / 3) * (ROWS / 3 + 1) / 2;

/** \brief Moves the lanes' sums into double precision and clears them. */
inline void flush(float (&lanes)[9 * TILES][LANES], Sums& sums) {
  int tile = 0;
  for (int i = 0; i < ROWS; i += 3)
    for (int j = i; j < ROWS; j += 3, ++tile)
      for (int k = 0; k < 9; ++k) {
        float* s = lanes[9 * tile + k];
        sums.products[i + k / 3][j + k % 3] += static_cast<double>(sum(load(s)));
        store(s, Float{});
      }
}

template <Residual KIND, bool ROBUST, bool DERIVATIVES>
void accumulate(const Points& points, const Shape& shape, const Mixture& m, Sums& out) {
  constexpr std::size_t FLUSH = 16; // blocks whose sums stay in single precision
  alignas(64) float rows[ROWS][BLOCK];
  alignas(64) float lanes[9 * TILES][LANES] = {};
  alignas(64) float feet[4][BLOCK];
  const Lanes l = spread(shape);
  const Float s = all(m.inverse_two_sigma_squared), c = all(m.outlier);
  const Float inverse_s = all(1.0F / m.inverse_two_sigma_squared);
  const Float log_full = log(all(1.0F) + c);
  const Float index = laneIndex();
  __builtin_memset(&out, 0, sizeof(out));
  std::size_t block = 0;
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    if constexpr (KIND == Residual::FOOT_POINT)
      footBlock(l, points, begin, feet);
    std::size_t p = 0;
    for (; p < size; p += LANES) {
      const Vector y = local(l, points, begin + p);
      Row r;
      if constexpr (KIND == Residual::FOOT_POINT)
        r = footRow(l, y, loadFoot(feet, p));
      else
        r = row<KIND>(l, y);
      store(rows[11] + p, r.residual);
      if (DERIVATIVES)
        storeDerivatives(r, rows, p);
    }
    Float cost{}, share{};
    const Float valid_count = all(static_cast<float>(size));
    for (p = 0; p < size; p += LANES) {
      const Float valid = select(
          index + all(static_cast<float>(p)) < valid_count, all(1.0F), all(0.0F));
      const Float q = points.precision ? load(points.precision + begin + p) : all(1.0F);
      const Float r = load(rows[11] + p);
      const Weight w = weight<ROBUST>(q * r * r, s, c, inverse_s, log_full);
      cost += valid * w.cost;
      share += valid * w.share;
      if (DERIVATIVES) {
        const Float root = sqrt(valid * w.share * q);
        for (int i = 0; i < ROWS; ++i)
          store(rows[i] + p, root * load(rows[i] + p));
      }
    }
    out.cost += static_cast<double>(sum(cost));
    out.share += static_cast<double>(sum(share));
    if (DERIVATIVES) {
      for (; p < BLOCK; p += LANES)
        for (int i = 0; i < ROWS; ++i)
          store(rows[i] + p, Float{});
      addProducts(rows, lanes);
      if (++block % FLUSH == 0)
        flush(lanes, out);
    }
  }
  if (DERIVATIVES)
    flush(lanes, out);
}

template <Residual KIND, bool DERIVATIVES>
void accumulate(const Points& points, const Shape& shape, const Mixture& m, Sums& out) {
  if (m.outlier > 0.0F)
    accumulate<KIND, true, DERIVATIVES>(points, shape, m, out);
  else
    accumulate<KIND, false, DERIVATIVES>(points, shape, m, out);
}

template <bool DERIVATIVES>
void accumulate(const Points& points,
                const Shape& shape,
                Residual kind,
                const Mixture& m,
                Sums& out) {
  switch (kind) {
  case Residual::RADIAL:
    return accumulate<Residual::RADIAL, DERIVATIVES>(points, shape, m, out);
  case Residual::FIRST_ORDER:
    return accumulate<Residual::FIRST_ORDER, DERIVATIVES>(points, shape, m, out);
  case Residual::FOOT_POINT:
    return accumulate<Residual::FOOT_POINT, DERIVATIVES>(points, shape, m, out);
  case Residual::GAUGE:
    return accumulate<Residual::GAUGE, DERIVATIVES>(points, shape, m, out);
  case Residual::SOLINA:
    return accumulate<Residual::SOLINA, DERIVATIVES>(points, shape, m, out);
  }
}

template <Residual KIND>
void residuals(const Points& points, const Shape& shape, float* out) {
  const Lanes l = spread(shape);
  std::size_t i = 0;
  for (; i + LANES <= points.count; i += LANES)
    store(out + i, residual<KIND>(l, local(l, points, i)));
  if (i < points.count) { // the output has no room beyond its last point
    alignas(64) float rest[LANES];
    store(rest, residual<KIND>(l, local(l, points, i)));
    for (std::size_t k = 0; i + k < points.count; ++k)
      out[i + k] = rest[k];
  }
}

void residuals(const Points& points, const Shape& shape, Residual kind, float* out) {
  switch (kind) {
  case Residual::RADIAL:
    return residuals<Residual::RADIAL>(points, shape, out);
  case Residual::FIRST_ORDER:
    return residuals<Residual::FIRST_ORDER>(points, shape, out);
  case Residual::FOOT_POINT:
    return residuals<Residual::FOOT_POINT>(points, shape, out);
  case Residual::GAUGE:
    return residuals<Residual::GAUGE>(points, shape, out);
  case Residual::SOLINA:
    return residuals<Residual::SOLINA>(points, shape, out);
  }
}

constexpr Kernels table(const char* name) {
  return {name, &accumulate<true>, &residuals, &accumulate<false>};
}

} // namespace
