// SPDX-License-Identifier: BSD-3-Clause
#define PCL_SQ_LANES 8
#include "kernel_impl.h"

namespace pcl_sq::kernels {

extern const Kernels KERNELS_AVX2;
const Kernels KERNELS_AVX2 = table("avx2");

} // namespace pcl_sq::kernels
