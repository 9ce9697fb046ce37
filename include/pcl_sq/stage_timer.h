// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq {

/** \brief Runs the stages of a pipeline and notes how long each took. */
class StageTimer {
public:
  /** \param[out] timings_ms stage and wall time [ms], appended in order */
  explicit StageTimer(std::vector<std::pair<std::string, double>>& timings_ms)
      : timings_ms_(timings_ms) {}

  /** \brief Runs one stage. \return what \a stage returned */
  template <typename Stage>
  auto run(const std::string& name, const Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    timings_ms_.emplace_back(name,
                             std::chrono::duration<double, std::milli>(
                                 std::chrono::steady_clock::now() - start)
                                 .count());
    return result;
  }

private:
  std::vector<std::pair<std::string, double>>& timings_ms_;
};

} // namespace pcl_sq
