// SPDX-License-Identifier: BSD-3-Clause
// Private. The loops themselves, written once for any number of lanes and included by
// one file per instruction set, which defines PCL_SQ_LANES.
#pragma once

#include "kernel_bent.h"
#include "kernel_sums.h"
#include "kernel_vessel.h"

namespace {

/** \brief Rows of one block of planes: derivatives of the support function, which is
 * the gauge of a superquadric with axes 1/a and exponents 2 - e, and the residual. */
inline void planeBlock(const Lanes& dual,
                       const Planes& planes,
                       std::size_t begin,
                       std::size_t size,
                       float (&rows)[ROWS][BLOCK]) {
  for (std::size_t p = 0; p < size; p += LANES) {
    const std::size_t i = begin + p;
    const Float x = load(planes.x + i), y = load(planes.y + i), z = load(planes.z + i);
    const Vector u = turned(dual, x, y, z);
    const Gauge g = gauge(dual, u);
    const Float h = exp(g.value);
    const Vector contact = {h * g.gradient.x, h * g.gradient.y, h * g.gradient.z};
    const Float beyond = h + dot(u, {dual.offset[0], dual.offset[1], dual.offset[2]}) -
                         load(planes.offset + i);
    const Float w =
        select(beyond > load(planes.least + i), load(planes.weight + i), Float{});
    store(rows[0] + p, w * u.x);
    store(rows[1] + p, w * u.y);
    store(rows[2] + p, w * u.z);
    store(rows[3] + p, w * (contact.y * u.z - contact.z * u.y));
    store(rows[4] + p, w * (contact.z * u.x - contact.x * u.z));
    store(rows[5] + p, w * (contact.x * u.y - contact.y * u.x));
    store(rows[6] + p, w * h * g.a1);
    store(rows[7] + p, w * h * g.a2);
    store(rows[8] + p, w * h * g.a3);
    store(rows[9] + p, -w * h * g.e1);
    store(rows[10] + p, -w * h * g.e2);
    store(rows[11] + p, w * beyond);
  }
}

/** \brief The same for tapered bodies, found by search: see taperedSupport(). */
inline void planeBlock(const TaperedSupport& support,
                       const Planes& planes,
                       std::size_t begin,
                       std::size_t size,
                       float (&rows)[TAPERED_ROWS][BLOCK]) {
  for (std::size_t p = 0; p < size; p += LANES)
    support.row(planes, begin + p, rows, p);
}

template <typename Support, int R>
void planeSums(const Support& support, const Planes& planes, PlaneSumsOf<R>& out) {
  alignas(64) float rows[R][BLOCK];
  alignas(64) float lanes[productsOf(R)][LANES] = {};
  Float shared[R] = {};
  __builtin_memset(&out, 0, sizeof(out));
  for (std::size_t begin = 0; begin < planes.count; begin += BLOCK) {
    const std::size_t rest = planes.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    planeBlock(support, planes, begin, size, rows);
    for (std::size_t p = 0; p < size; p += LANES)
      for (int i = 0; i < R; ++i)
        shared[i] += load(planes.shared + begin + p) * load(rows[i] + p);
    addProducts(rows, size, lanes);
  }
  flush(lanes, out.products);
  for (int i = 0; i < R; ++i)
    out.shared[i] = static_cast<double>(sum(shared[i]));
}

inline void straightPlanes(const Planes& planes, const Shape& shape, PlaneSums& out) {
  planeSums(spreadDual(shape), planes, out);
}

inline void taperedPlanes(const Planes& planes,
                          const Shape& shape,
                          PlaneSumsOf<TAPERED_ROWS>& out) {
  planeSums(TaperedSupport(shape), planes, out);
}

inline void taperedRows(const Planes& planes,
                        const Shape& shape,
                        float (&rows)[TAPERED_ROWS][BLOCK]) {
  planeBlock(TaperedSupport(shape), planes, 0, planes.count, rows);
}

constexpr Kernels table(const char* name) {
  return {name,
          &accumulate<true>,
          &residuals,
          &accumulate<false>,
          &straightPlanes,
          &taperedResiduals,
          &taperedEquations,
          &taperedPlanes,
          &taperedRows,
          &outlineDistances,
          &vesselEquations,
          &bentEquations,
          &bentResiduals};
}

} // namespace
