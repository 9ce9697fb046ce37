// SPDX-License-Identifier: BSD-3-Clause
#include "report/ordered_lines.h"

#include <algorithm>

namespace pcl_sq::app {

OrderedLines::OrderedLines(const std::string& path, std::size_t window)
    : file_(path), window_(window) {}

void OrderedLines::put(std::size_t number, const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.emplace(number, line);
  writeWaiting(waiting_.size() > window_);
}

void OrderedLines::flush() {
  const std::lock_guard<std::mutex> lock(mutex_);
  writeWaiting(true);
}

std::string OrderedLines::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

void OrderedLines::writeWaiting(bool all) {
  while (!waiting_.empty() && failure_.empty() &&
         (all || waiting_.begin()->first <= next_)) {
    const auto line = waiting_.begin();
    if (file_.append(line->second, &failure_))
      failure_.clear();
    next_ = std::max(next_, line->first + 1);
    waiting_.erase(line);
  }
}

} // namespace pcl_sq::app
