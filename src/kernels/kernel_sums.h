// SPDX-License-Identifier: BSD-3-Clause
// Private. Residuals of points, and their sums of squares and products.
#pragma once

#include "kernel_tapered.h"

namespace {

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
inline void storeDerivatives(const Row& r, float (*rows)[BLOCK], std::size_t p) {
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

/** \brief Adds the products of one block's rows, kept as sums per lane.
 * \param[in] end of the block's points; zero up to the next whole vector */
template <int R>
inline void
addProducts(const float (&rows)[R][BLOCK], std::size_t end, float (*lanes)[LANES]) {
  static_assert(R % 3 == 0, "tiles of three rows");
  for (int i = 0; i < R; i += 3)
    for (int j = i; j < R; j += 3) {
      Float s[9];
      for (int k = 0; k < 9; ++k)
        s[k] = load(lanes[k]);
      for (std::size_t p = 0; p < end; p += LANES) {
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

/** \brief Products of that many rows: the tiles of the upper triangle. */
constexpr int productsOf(int rows) {
  return 9 * (rows / 3) * (rows / 3 + 1) / 2;
}

/** \brief Moves the lanes' sums into double precision and clears them. */
template <int R>
inline void flush(float (&lanes)[productsOf(R)][LANES], double (&products)[R][R]) {
  int tile = 0;
  for (int i = 0; i < R; i += 3)
    for (int j = i; j < R; j += 3, ++tile)
      for (int k = 0; k < 9; ++k) {
        float* s = lanes[9 * tile + k];
        products[i + k / 3][j + k % 3] += static_cast<double>(sum(load(s)));
        store(s, Float{});
      }
}

/** \tparam R TAPERED_ROWS for a tapered body, which knows FOOT_POINT only */
template <int R, Residual KIND, bool ROBUST, bool DERIVATIVES>
void accumulate(const Points& points,
                const Shape& shape,
                const Mixture& m,
                SumsOf<R>& out) {
  constexpr bool TAPERED = R == TAPERED_ROWS;
  constexpr int RESIDUAL = TAPERED ? TAPERED_PARAMETERS : PARAMETERS; // its row
  constexpr std::size_t FLUSH = 16; // blocks whose sums stay in single precision
  alignas(64) float rows[R][BLOCK];
  alignas(64) float lanes[productsOf(R)][LANES] = {};
  alignas(64) float feet[4][BLOCK];
  const Lanes l = spread(shape);
  const Taper taper = {all(shape.kx), all(shape.ky)};
  const Float s = all(m.inverse_two_sigma_squared), c = all(m.outlier);
  const Float inverse_s = all(1.0F / m.inverse_two_sigma_squared);
  const Float log_full = log(all(1.0F) + c);
  const Float index = laneIndex();
  __builtin_memset(&out, 0, sizeof(out));
  std::size_t block = 0;
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    if constexpr (KIND == Residual::FOOT_POINT && !TAPERED)
      footBlock(l, points, begin, feet);
    std::size_t p = 0;
    for (; p < size; p += LANES) {
      const Vector y = local(l, points, begin + p);
      Row r;
      if constexpr (TAPERED)
        r = taperedRow(l, taper, y, rows, p);
      else if constexpr (KIND == Residual::FOOT_POINT)
        r = footRow(l, y, loadFoot(feet, p));
      else
        r = row<KIND>(l, y);
      store(rows[RESIDUAL] + p, r.residual);
      if (DERIVATIVES)
        storeDerivatives(r, rows, p);
    }
    Float cost{}, share{};
    const Float valid_count = all(static_cast<float>(size));
    for (p = 0; p < size; p += LANES) {
      const Float valid = select(
          index + all(static_cast<float>(p)) < valid_count, all(1.0F), all(0.0F));
      const Float q = points.precision ? load(points.precision + begin + p) : all(1.0F);
      const Float r = load(rows[RESIDUAL] + p);
      const Weight w = weight<ROBUST>(q * r * r, s, c, inverse_s, log_full);
      cost += valid * w.cost;
      share += valid * w.share;
      if (DERIVATIVES) {
        const Float root = sqrt(valid * w.share * q);
        for (int i = 0; i <= RESIDUAL; ++i)
          store(rows[i] + p, root * load(rows[i] + p));
        if constexpr (TAPERED)
          store(rows[R - 1] + p, Float{});
      }
    }
    out.cost += static_cast<double>(sum(cost));
    out.share += static_cast<double>(sum(share));
    if (DERIVATIVES) {
      addProducts(rows, size, lanes);
      if (++block % FLUSH == 0)
        flush(lanes, out.products);
    }
  }
  if (DERIVATIVES)
    flush(lanes, out.products);
}

template <Residual KIND, bool DERIVATIVES>
void accumulate(const Points& points, const Shape& shape, const Mixture& m, Sums& out) {
  if (m.outlier > 0.0F)
    accumulate<ROWS, KIND, true, DERIVATIVES>(points, shape, m, out);
  else
    accumulate<ROWS, KIND, false, DERIVATIVES>(points, shape, m, out);
}

inline void taperedEquations(const Points& points,
                             const Shape& shape,
                             const Mixture& m,
                             SumsOf<TAPERED_ROWS>& out) {
  constexpr Residual FOOT = Residual::FOOT_POINT;
  if (m.outlier > 0.0F)
    accumulate<TAPERED_ROWS, FOOT, true, true>(points, shape, m, out);
  else
    accumulate<TAPERED_ROWS, FOOT, false, true>(points, shape, m, out);
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

inline void taperedResiduals(const Points& points, const Shape& shape, float* out) {
  alignas(64) float rows[TAPERED_ROWS][BLOCK]; // those of the taper, not wanted here
  alignas(64) float block[BLOCK];
  const Lanes l = spread(shape);
  const Taper taper = {all(shape.kx), all(shape.ky)};
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    for (std::size_t p = 0; p < size; p += LANES)
      store(block + p,
            taperedRow(l, taper, local(l, points, begin + p), rows, p).residual);
    __builtin_memcpy(out + begin, block, size * sizeof(float));
  }
}

inline void
residuals(const Points& points, const Shape& shape, Residual kind, float* out) {
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

} // namespace
