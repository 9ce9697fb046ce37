// SPDX-License-Identifier: BSD-3-Clause
// Which of many clouds one process does, and which were done before.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief The names in a file, one a line; empty lines and those that begin with # are
 * left out. \throw Failure if it cannot be read or names nothing */
std::vector<std::string> readManifest(const std::string& path);

/** \brief The names of share \a shard, "I/N" with I from 1 to N: every Nth, so that
 * neighbours, which are alike, are spread. \throw UsageError for another text */
std::vector<std::string> shardOf(const std::vector<std::string>& names,
                                 const std::string& shard);

/** \brief What an earlier run has left in its file of lines. */
struct DoneLines {
  std::string text;                        ///< whole lines, without the last one's end
  std::map<std::string, std::size_t> done; ///< how often each cloud is among them
  bool all_fitted = true;                  ///< whether none of them is an error
};

/** \brief Reads the whole lines of a file; a last one without its end was cut and is
 * left out. A file that is absent has none. \throw Failure if a line is not ours */
DoneLines readDoneLines(const std::string& path);

/** \brief The names that are not done yet. */
std::vector<std::string> withoutDone(const std::vector<std::string>& names,
                                     DoneLines& lines);

} // namespace pcl_sq::app
