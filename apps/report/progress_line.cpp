// SPDX-License-Identifier: BSD-3-Clause
// What long work is at, on a terminal.
#include "command_line/app.h"

#include <algorithm>
#include <cstdio>
#include <mutex>

#include <unistd.h>

namespace pcl_sq::app {

namespace {

bool visible() {
  return !quiet() && isatty(STDERR_FILENO) != 0;
}

std::mutex& lineMutex() {
  static std::mutex mutex;
  return mutex;
}

void clearLine() {
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

} // namespace

void StageLine::clear() {
  const std::lock_guard<std::mutex> lock(lineMutex());
  if (!shown_.empty())
    clearLine();
  shown_.clear();
}

void StageLine::show(const std::string& stage, double share) {
  if (!visible())
    return;
  std::string line = stage + " ...";
  if (share > 0.0)
    line += " " + std::to_string(int(100.0 * std::min(share, 1.0))) + " %";
  const std::lock_guard<std::mutex> lock(lineMutex());
  if (line == shown_)
    return;
  shown_ = line;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(std::max<std::size_t>(total, 1)),
      visible_(visible()) {
  update(0);
}

Progress::~Progress() {
  if (visible_)
    clearLine();
}

void Progress::update(std::size_t done) {
  if (!visible_)
    return;
  const std::lock_guard<std::mutex> lock(lineMutex());
  constexpr int WIDTH = 30;
  const int filled = int(WIDTH * std::min(done, total_) / total_);
  std::fprintf(stderr,
               "\r\033[K%s [%s%s] %zu/%zu",
               what_.c_str(),
               std::string(filled, '#').c_str(),
               std::string(WIDTH - filled, '.').c_str(),
               done,
               total_);
  std::fflush(stderr);
}

} // namespace pcl_sq::app
