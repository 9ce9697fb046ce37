// SPDX-License-Identifier: BSD-3-Clause
// Private. Vectors of LANES floats on the compiler's vector extension, everything with
// internal linkage: a function compiled for wide registers must never be merged by the
// linker with one of the same name that is called on a smaller machine.
#pragma once

#ifndef PCL_SQ_LANES
#error "define PCL_SQ_LANES (1, 4, 8 or 16) before including this file"
#endif

#if PCL_SQ_LANES > 1 && (defined(__SSE2__) || defined(__AVX__))
#include <immintrin.h>
#endif

namespace {

inline constexpr int LANES = PCL_SQ_LANES;

#if PCL_SQ_LANES == 1
using Float = float;
using Int = int;
inline Float select(bool mask, Float a, Float b) {
  return mask ? a : b;
}
inline Float max(Float a, Float b) {
  return a > b ? a : b;
}
inline Float min(Float a, Float b) {
  return a < b ? a : b;
}
inline Float abs(Float x) {
  return __builtin_fabsf(x);
}
inline Float withSign(Float x, Float s) {
  return __builtin_copysignf(x, s);
}
inline Float log(Float x) {
  return __builtin_logf(x);
}
inline Float exp(Float x) {
  return __builtin_expf(x);
}
inline Float sqrt(Float x) {
  return __builtin_sqrtf(x);
}
inline float sum(Float x) {
  return x;
}
inline Float laneIndex() {
  return 0.0F;
}
inline Float inverse(Float x) {
  return 1.0F / x;
}
#else
typedef float Float __attribute__((vector_size(4 * PCL_SQ_LANES)));
typedef int Int __attribute__((vector_size(4 * PCL_SQ_LANES)));

inline Float select(Int mask, Float a, Float b) {
  return mask ? a : b;
}
#if PCL_SQ_LANES == 16
inline Float max(Float a, Float b) {
  return _mm512_maskz_max_ps(0xffff, a, b);
}
inline Float min(Float a, Float b) {
  return _mm512_maskz_min_ps(0xffff, a, b);
}
#elif PCL_SQ_LANES == 8
inline Float max(Float a, Float b) {
  return _mm256_max_ps(a, b);
}
inline Float min(Float a, Float b) {
  return _mm256_min_ps(a, b);
}
#elif defined(__SSE2__)
inline Float max(Float a, Float b) {
  return _mm_max_ps(a, b);
}
inline Float min(Float a, Float b) {
  return _mm_min_ps(a, b);
}
#else
inline Float max(Float a, Float b) {
  return select(a > b, a, b);
}
inline Float min(Float a, Float b) {
  return select(a < b, a, b);
}
#endif
inline Int bits(Float x) {
  return reinterpret_cast<Int>(x);
}
inline Float fromBits(Int x) {
  return reinterpret_cast<Float>(x);
}
inline Float abs(Float x) {
  return fromBits(bits(x) & 0x7fffffff);
}
/** \brief The non-negative \a x with the sign of \a s. */
inline Float withSign(Float x, Float s) {
  return fromBits(bits(x) | (bits(s) & static_cast<int>(0x80000000U)));
}
inline Float sqrt(Float x) {
#if PCL_SQ_LANES == 16
  return _mm512_maskz_sqrt_ps(0xffff, x);
#elif PCL_SQ_LANES == 8
  return _mm256_sqrt_ps(x);
#elif defined(__SSE2__)
  return _mm_sqrt_ps(x);
#else
  for (int i = 0; i < LANES; ++i)
    x[i] = __builtin_sqrtf(x[i]);
  return x;
#endif
}
/** \brief 1/x: the processor's estimate and one step of Newton's, which is as exact as
 * the division and takes a quarter of its time. */
inline Float inverse(Float x) {
#if PCL_SQ_LANES == 16
  const Float r = _mm512_maskz_rcp14_ps(0xffff, x);
  return r + r * (1.0F - x * r);
#elif PCL_SQ_LANES == 8
  const Float r = _mm256_rcp_ps(x);
  return r + r * (1.0F - x * r);
#else
  return 1.0F / x;
#endif
}
template <int COUNT>
struct Vec {
  typedef float Type __attribute__((vector_size(4 * COUNT)));
};
/** \brief Adds half to half: one lane after the other would wait for each addition. */
template <int COUNT>
inline float sumOf(typename Vec<COUNT>::Type x) {
  if constexpr (COUNT == 2) {
    return x[0] + x[1];
  } else {
    typename Vec<COUNT / 2>::Type low, high;
    __builtin_memcpy(&low, &x, sizeof(low));
    __builtin_memcpy(
        &high, reinterpret_cast<const char*>(&x) + sizeof(low), sizeof(high));
    return sumOf<COUNT / 2>(low + high);
  }
}
inline float sum(Float x) {
  return sumOf<LANES>(x);
}
inline Float laneIndex() {
  Float v{};
  for (int i = 0; i < LANES; ++i)
    v[i] = static_cast<float>(i);
  return v;
}

/** \brief Natural logarithm of a positive normal number, about 1 ulp: split off the
 * power of two, then a minimax polynomial on [sqrt(1/2), sqrt(2)) (Cephes' constants).
 */
inline Float log(Float x) {
  const Int i = bits(x);
  const Int exponent = (i - 0x3f3504f3) >> 23;
  const Float f = fromBits(i - (exponent << 23)) - 1.0F;
  const Float n = __builtin_convertvector(exponent, Float);
  const Float f2 = f * f;
  const Float f4 = f2 * f2;
  // Estrin's order: short chains instead of one long one
  const Float p0 = (-1.6668057665e-1F * f + 2.0000714765e-1F) * f2 +
                   (-2.4999993993e-1F * f + 3.3333331174e-1F);
  const Float p4 = (-1.1514610310e-1F * f + 1.1676998740e-1F) * f2 +
                   (-1.2420140846e-1F * f + 1.4249322787e-1F);
  Float y = (7.0376836292e-2F * f4 + p4) * f4 + p0;
  y = y * f * f2 - 2.12194440e-4F * n - 0.5F * f2;
  return f + y + 0.693359375F * n;
}

/** \brief e^x for x in [-87, 88] (clamped), about 1 ulp (Cephes' constants). */
inline Float exp(Float x) {
  x = min(max(x, Float{} - 87.0F), Float{} + 88.0F);
  // adding 1.5 * 2^23 rounds to an integer, which then stands in the low bits
  const Float shifted = x * 1.44269504088896341F + 12582912.0F;
  const Int n = bits(shifted) - 0x4b400000;
  const Float k = shifted - 12582912.0F;
  x = x - k * 0.693359375F + k * 2.12194440e-4F;
  const Float x2 = x * x;
  Float y = (8.3334519073e-3F * x + 4.1665795894e-2F) * x2 +
            (1.6666665459e-1F * x + 5.0000001201e-1F);
  y = (1.9875691500e-4F * x + 1.3981999507e-3F) * (x2 * x2) + y;
  y = y * x2 + (x + 1.0F);
  return y * fromBits((n + 127) << 23);
}
#endif

inline Float load(const float* p) {
  Float v;
  __builtin_memcpy(&v, p, sizeof(v));
  return v;
}
inline void store(float* p, Float v) {
  __builtin_memcpy(p, &v, sizeof(v));
}
inline Float all(float x) {
  return Float{} + x;
}

} // namespace
