// SPDX-License-Identifier: BSD-3-Clause
#define PCL_SQ_LANES 16
#include "kernel_impl.h"

namespace pcl_sq::kernels {

extern const Kernels KERNELS_AVX512;
const Kernels KERNELS_AVX512 = table("avx512");

} // namespace pcl_sq::kernels
