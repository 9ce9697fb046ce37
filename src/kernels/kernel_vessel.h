// SPDX-License-Identifier: BSD-3-Clause
// Private. Distances of points to solids of revolution with a rim, told by the outline
// of half a section through their axis; those of open vessels with derivatives.
#pragma once

#include "kernel_weights.h"

namespace {

#if PCL_SQ_LANES == 1
inline float least(Float x) {
  return x;
}
#else
/** \brief The smallest lane: half beside half, as sumOf(). */
template <int COUNT>
inline float leastOf(typename Vec<COUNT>::Type x) {
  if constexpr (COUNT == 2) {
    return x[0] < x[1] ? x[0] : x[1];
  } else {
    typename Vec<COUNT / 2>::Type low, high;
    __builtin_memcpy(&low, &x, sizeof(low));
    __builtin_memcpy(
        &high, reinterpret_cast<const char*>(&x) + sizeof(low), sizeof(high));
    return leastOf<COUNT / 2>(low < high ? low : high);
  }
}
inline float least(Float x) {
  return leastOf<LANES>(x);
}
#endif

/** \brief Squared distance to a side, or of a place to several. */
inline Float squareTo(
    Float x, Float y, Float along_x, Float along_y, Float inverse, Float rho, Float z) {
  const Float dx = rho - x, dy = z - y;
  const Float t =
      min(max((dx * along_x + dy * along_y) * inverse, all(0.0F)), all(1.0F));
  const Float ex = dx - t * along_x, ey = dy - t * along_y;
  return ex * ex + ey * ey;
}

/** \brief The same of a vector of places. */
inline Float squareTo(const Sides& s, int i, Float rho, Float z) {
  return squareTo(all(s.x[i]),
                  all(s.y[i]),
                  all(s.along_x[i]),
                  all(s.along_y[i]),
                  all(s.inverse[i]),
                  rho,
                  z);
}

/** \brief Squared distances to a curve: its coarse chords tell near which of the fine
 * ones the foot is; it may lie beside the coarse one's. */
inline Float
squareToCurve(const Sides& coarse, const Sides& fine, const Float rho, const Float z) {
  Float nearest = all(1e30F), which = all(0.0F);
  for (int i = 0; i < Outline::STEPS; ++i) {
    const Float square = squareTo(coarse, i, rho, z);
    which = select(square < nearest, all(float(i)), which);
    nearest = min(square, nearest);
  }
  alignas(64) float chord[LANES], at_rho[LANES], at_z[LANES], squares[LANES];
  store(chord, which);
  store(at_rho, rho);
  store(at_z, z);
  for (int k = 0; k < LANES; ++k) {
    Float square = all(1e30F);
    const int begin = Outline::FINE * int(chord[k]);
    for (int i = begin; i < begin + 3 * Outline::FINE; i += LANES)
      square = min(square,
                   squareTo(load(fine.x + i),
                            load(fine.y + i),
                            load(fine.along_x + i),
                            load(fine.along_y + i),
                            load(fine.inverse + i),
                            all(at_rho[k]),
                            all(at_z[k])));
    squares[k] = least(square);
  }
  return load(squares);
}

/** \brief -1 inside a polygon, 1 outside: how often a ray crosses its sides. */
inline Float sideOf(const Outline& o, Float rho, Float z) {
  Float sign = all(1.0F);
  const Sides& s = o.polygon;
  for (int i = 0; i < o.corners; ++i) {
    const Float from = all(s.y[i]), to = all(s.y[i] + s.along_y[i]);
    const Float crossing = all(s.x[i]) + (z - from) * all(s.inverse[i]);
    sign = select(((from > z) ^ (to > z)) & (rho < crossing), -sign, sign);
  }
  return sign;
}

inline void outlineDistances(const Points& points,
                             const Shape& shape,
                             const Outline& o,
                             float* out) {
  const Lanes l = spread(shape);
  alignas(64) float rest[LANES];
  for (std::size_t i = 0; i < points.count; i += LANES) {
    const Vector p = local(l, points, i);
    const Float rho = sqrt(p.x * p.x + p.y * p.y);
    Float square = all(1e30F);
    for (int k = 0; k < o.edges; ++k)
      square = min(square, squareTo(o.edge, k, rho, p.z));
    for (int k = 0; k < o.curves; ++k)
      square = min(square, squareToCurve(o.coarse[k], o.fine[k], rho, p.z));
    store(rest, sideOf(o, rho, p.z) * sqrt(square));
    const std::size_t left = points.count - i;
    __builtin_memcpy(out + i, rest, (left < LANES ? left : LANES) * sizeof(float));
  }
}

/** \brief Which walls a vector of points may lie on: 1, or 0. */
struct Walls {
  Float outer, inner;
};

inline Walls wallsOf(const Vessel& v, const Vector& p) {
  const Float yes = all(1.0F), no = all(0.0F);
  if (!v.has_eye)
    return {yes, yes};
  if (!(v.eye[2] > v.rim))
    return {yes, no};
  const Float ex = all(v.eye[0]), ey = all(v.eye[1]), ez = all(v.eye[2]);
  const Float fall = min(p.z - ez, all(-1e-12F)); // seen from above
  const Float along = (v.rim - ez) * inverse(fall);
  const Float x = ex + along * (p.x - ex), y = ey + along * (p.y - ey);
  const Float crossing = sqrt(x * x + y * y);
  const auto below = p.z < ez;
  return {select(below & (crossing < all(v.narrow)), no, yes),
          select(below & (crossing < all(v.wide)), yes, no)};
}

/** \brief The nearest chord, and its numbers lane by lane. */
struct NearChord {
  Float x, y, along_x, along_y, inverse;
  Float begin[2][VesselChord::SLOPES], end[2][VesselChord::SLOPES];
};

inline NearChord chordsOf(const Vessel& v, Float which) {
  static_assert(sizeof(NearChord) / sizeof(Float) ==
                    sizeof(VesselChord) / sizeof(float),
                "the same numbers");
  constexpr int COUNT = sizeof(VesselChord) / sizeof(float);
  alignas(64) float index[LANES], numbers[COUNT][LANES];
  store(index, which);
  for (int lane = 0; lane < LANES; ++lane) {
    float chord[COUNT];
    __builtin_memcpy(chord, v.chords + int(index[lane]), sizeof(chord));
    for (int k = 0; k < COUNT; ++k)
      numbers[k][lane] = chord[k];
  }
  NearChord near;
  __builtin_memcpy(&near, numbers, sizeof(near));
  return near;
}

inline void
vesselRow(const Vessel& v, const Vector& p, float (&rows)[ROWS][BLOCK], std::size_t i) {
  const Float far = all(1e30F), none = all(0.0F);
  const Float rho = sqrt(p.x * p.x + p.y * p.y);
  const Walls walls = wallsOf(v, p);
  Float nearest = far, which = none;
  for (int k = 0; k < v.count; ++k) {
    const VesselChord& c = v.chords[k];
    const Float square = squareTo(
        all(c.x), all(c.y), all(c.along_x), all(c.along_y), all(c.inverse), rho, p.z);
    const auto nearer =
        (square < nearest) & ((k < v.outer ? walls.outer : walls.inner) > none);
    which = select(nearer, all(float(k)), which);
    nearest = select(nearer, square, nearest);
  }
  const NearChord c = chordsOf(v, which);
  const Float dx = rho - c.x, dy = p.z - c.y;
  const Float t =
      min(max((dx * c.along_x + dy * c.along_y) * c.inverse, none), all(1.0F));
  const Float off_x = dx - t * c.along_x, off_y = dy - t * c.along_y;
  // beside a chord the normal is the chord's, however near the point is
  const Float root = sqrt(c.inverse);
  const Float side_x = c.along_y * root, side_y = -c.along_x * root;
  const Float beside = dx * side_x + dy * side_y;
  const auto within = (t > none) & (t < all(1.0F));
  const Float length_off = sqrt(off_x * off_x + off_y * off_y);
  const Float inverse_off = inverse(max(length_off, all(1e-12F)));
  const Float sign = withSign(all(1.0F), beside);
  const Float nx = select(within, sign * side_x, off_x * inverse_off);
  const Float ny = select(within, sign * side_y, off_y * inverse_off);
  const Float seen = select(nearest < far, all(1.0F), none);
  const Float inverse_rho = inverse(max(rho, all(1e-12F)));
  const Vector normal = {nx * p.x * inverse_rho, nx * p.y * inverse_rho, ny};
  store(rows[0] + i, -seen * normal.x);
  store(rows[1] + i, -seen * normal.y);
  store(rows[2] + i, -seen * normal.z);
  store(rows[3] + i, seen * (normal.y * p.z - normal.z * p.y));
  store(rows[4] + i, seen * (normal.z * p.x - normal.x * p.z));
  for (int k = 0; k < VesselChord::SLOPES; ++k) {
    const Float rho_slope = c.begin[0][k] + t * (c.end[0][k] - c.begin[0][k]),
                z_slope = c.begin[1][k] + t * (c.end[1][k] - c.begin[1][k]);
    store(rows[5 + k] + i, -seen * (nx * rho_slope + ny * z_slope));
  }
  store(rows[PARAMETERS] + i, seen * length_off);
}

template <bool ROBUST>
void vesselSums(const Points& points,
                const Shape& shape,
                const Vessel& vessel,
                const Mixture& m,
                Sums& out) {
  alignas(64) float rows[ROWS][BLOCK];
  const Lanes l = spread(shape);
  WeightedSums<ROWS, PARAMETERS, ROBUST, true> sums(m, out);
  for (std::size_t begin = 0; begin < points.count; begin += BLOCK) {
    const std::size_t rest = points.count - begin;
    const std::size_t size = rest < BLOCK ? rest : BLOCK;
    for (std::size_t p = 0; p < size; p += LANES)
      vesselRow(vessel, local(l, points, begin + p), rows, p);
    sums.add(points, begin, size, rows);
  }
  sums.end();
}

inline void vesselEquations(const Points& points,
                            const Shape& shape,
                            const Vessel& vessel,
                            const Mixture& m,
                            Sums& out) {
  if (m.outlier > 0.0F)
    vesselSums<true>(points, shape, vessel, m, out);
  else
    vesselSums<false>(points, shape, vessel, m, out);
}

} // namespace
