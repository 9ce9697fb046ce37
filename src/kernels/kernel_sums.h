// SPDX-License-Identifier: BSD-3-Clause
// Private. Residuals of points, and their sums of squares and products.
#pragma once

#include "kernel_tapered.h"
#include "kernel_weights.h"

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

/** \tparam R TAPERED_ROWS for a tapered body, which knows FOOT_POINT only */
template <int R, Residual KIND, bool ROBUST, bool DERIVATIVES>
void accumulate(const Points& points,
                const Shape& shape,
                const Mixture& m,
                SumsOf<R>& out) {
  constexpr bool TAPERED = R == TAPERED_ROWS;
  constexpr int RESIDUAL = TAPERED ? TAPERED_PARAMETERS : PARAMETERS; // its row
  alignas(64) float rows[R][BLOCK];
  alignas(64) float feet[4][BLOCK];
  const Lanes l = spread(shape);
  const Taper taper = {all(shape.kx), all(shape.ky)};
  WeightedSums<R, RESIDUAL, ROBUST, DERIVATIVES> sums(m, out);
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    if constexpr (KIND == Residual::FOOT_POINT && !TAPERED)
      footBlock(l, points, begin, feet);
    for (std::size_t p = 0; p < size; p += LANES) {
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
    sums.add(points, begin, size, rows);
  }
  sums.end();
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
