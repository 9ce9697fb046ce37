// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace pcl_sq::detail {

/** \brief Wall time since its construction. */
class Stopwatch {
public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

} // namespace pcl_sq::detail
