// SPDX-License-Identifier: BSD-3-Clause
#define PCL_SQ_LANES 1
#include "kernel_impl.h"

namespace pcl_sq::kernels {

extern const Kernels KERNELS_PORTABLE;
const Kernels KERNELS_PORTABLE = table("portable");

} // namespace pcl_sq::kernels
