// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/file_io.h"

#include <map>
#include <mutex>
#include <string>

namespace pcl_sq::app {

/** \brief Lines that are done in any order, by several threads, and written in theirs.
 *
 * A line is written as soon as those before it are; but when \a window lines wait for
 * one that does not come, they are written without it. */
class OrderedLines {
public:
  OrderedLines(const std::string& path, std::size_t window);

  /** \brief The line of a number, each number once. */
  void put(std::size_t number, const std::string& line);
  /** \brief Writes what waits: nothing more will come, or the program is ended. */
  void flush();
  /** \brief Why a line could not be written, or "". Nothing is written after that. */
  std::string failure() const;

private:
  void writeWaiting(bool all);

  mutable std::mutex mutex_;
  LineFile file_;
  std::size_t window_, next_ = 0;
  std::map<std::size_t, std::string> waiting_;
  std::string failure_;
};

} // namespace pcl_sq::app
