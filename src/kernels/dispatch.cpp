// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.h"

#include <initializer_list>

namespace pcl_sq::kernels {

extern const Kernels KERNELS_PORTABLE;
#if defined(__x86_64__)
extern const Kernels KERNELS_SSE2;
extern const Kernels KERNELS_AVX2;
extern const Kernels KERNELS_AVX512;
#endif

const Kernels* kernelsFor(Isa isa) {
  switch (isa) {
  case Isa::PORTABLE:
    return &KERNELS_PORTABLE;
#if defined(__x86_64__)
  case Isa::SSE2:
    return &KERNELS_SSE2;
  case Isa::AVX2:
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
               ? &KERNELS_AVX2
               : nullptr;
  case Isa::AVX512:
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512bw")
               ? &KERNELS_AVX512
               : nullptr;
#endif
  default:
    return nullptr;
  }
}

const Kernels& kernels() {
  static const Kernels* const widest = [] {
    for (const Isa isa : {Isa::AVX512, Isa::AVX2, Isa::SSE2})
      if (const Kernels* k = kernelsFor(isa))
        return k;
    return kernelsFor(Isa::PORTABLE);
  }();
  return *widest;
}

} // namespace pcl_sq::kernels
