// SPDX-License-Identifier: BSD-3-Clause
#define PCL_SQ_LANES 4
#include "kernel_impl.h"

namespace pcl_sq::kernels {

extern const Kernels KERNELS_SSE2;
const Kernels KERNELS_SSE2 = table("sse2");

} // namespace pcl_sq::kernels
