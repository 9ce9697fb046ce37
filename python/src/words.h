// SPDX-License-Identifier: BSD-3-Clause
// Keywords that have become the programs' words, as options.
#pragma once

#include "command_line/app.h"

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::python {

/** \brief The options that a program's words give. A loop calls with the same words
 * again and again: those of the last call are kept, for reading them takes longer than
 * a call may. \param[in] configure adds the options to a program \throw app::UsageError
 */
template <typename Options, typename Configure>
Options readWords(const char* name,
                  const std::vector<std::string>& words,
                  Configure configure) {
  static std::mutex mutex;
  static std::optional<std::pair<std::vector<std::string>, Options>> last;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (last && last->first == words)
      return last->second;
  }
  Options options;
  app::parseWords(
      name, [&](CLI::App& cli) { configure(cli, options); }, words);
  const std::lock_guard<std::mutex> lock(mutex);
  last.emplace(words, options);
  return options;
}

} // namespace pcl_sq::python
