// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

#include "pcl_sq/progress.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq {

/** \brief Runs the stages of a pipeline and notes how long each took. */
class StageTimer {
public:
  /** \param[out] timings_ms stage and wall time [ms], appended in order
   * \param[in] progress is told of each stage's begin and end (optional) */
  explicit StageTimer(std::vector<std::pair<std::string, double>>& timings_ms,
                      ProgressCallback progress = {})
      : timings_ms_(timings_ms), progress_(std::move(progress)) {}

  /** \brief Runs one stage. \return what \a stage returned */
  template <typename Stage>
  auto run(const std::string& name, const Stage& stage) {
    if (progress_)
      progress_(name, 0.0);
    const auto start = std::chrono::steady_clock::now();
    auto result = stage();
    timings_ms_.emplace_back(name,
                             std::chrono::duration<double, std::milli>(
                                 std::chrono::steady_clock::now() - start)
                                 .count());
    if (progress_)
      progress_(name, 1.0);
    return result;
  }

private:
  std::vector<std::pair<std::string, double>>& timings_ms_;
  ProgressCallback progress_;
};

} // namespace pcl_sq
