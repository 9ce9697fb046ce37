// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>

namespace pcl_sq::detail {

/** \brief Calls work(i) for i in [0, count), in any order and by several threads at
 * once; inside of another parallel loop by one. An exception is handed on after all are
 * done. \param[in] threads 0: one per core, but fewer on a busy machine: a thread that
 * waits for its turn there holds up the others for longer than it would have helped */
template <typename Work>
void parallelFor(std::size_t count, unsigned int threads, const Work& work) {
  // no more than there is work for: OpenMP ends the process where it cannot have them
  constexpr std::size_t MOST = 1024;
  const int n_threads =
      threads > 0
          ? int(std::clamp(std::min(count, MOST), std::size_t(1), std::size_t(threads)))
          : omp_get_num_procs();
  const int dynamic = omp_get_dynamic();
  omp_set_dynamic(threads == 0 ? 1 : dynamic);
  std::exception_ptr error; // must not leave the parallel region by itself
#pragma omp parallel for schedule(dynamic) num_threads(n_threads) if (count > 1)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      work(i);
    } catch (...) {
#pragma omp critical
      error = std::current_exception();
    }
  }
  omp_set_dynamic(dynamic);
  if (error)
    std::rethrow_exception(error);
}

} // namespace pcl_sq::detail
