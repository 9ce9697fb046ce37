// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/prism.h"

namespace pcl_sq::test {

/** \brief The pseudo-code of the paper. */
inline PrismOptions figure4(PrismRun run = PrismRun::CROSS) {
  PrismOptions options;
  options.method = PrismMethod::FIGURE_4;
  options.run = run;
  return options;
}

/** \brief All passes to the last cell, with no second thoughts. */
inline PrismOptions allPasses(PrismRun run) {
  PrismOptions options = figure4(run);
  options.max_uncovered = 0.0;
  options.merge = false;
  options.min_exclusive = 0.0;
  return options;
}

} // namespace pcl_sq::test
