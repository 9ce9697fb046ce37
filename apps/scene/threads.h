// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

namespace pcl_sq::app {

/** \brief Threads of a loop; 0 stands for as many as OpenMP is allowed
 * (OMP_NUM_THREADS). */
inline int threadCount(unsigned int threads) {
  return threads == 0 ? omp_get_max_threads() : static_cast<int>(threads);
}

} // namespace pcl_sq::app
