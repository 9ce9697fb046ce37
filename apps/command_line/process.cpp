// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/process.h"

#include "command_line/app.h"
#include "files/files.h"

#include <csignal>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace pcl_sq::app {

namespace {

/** \brief Lives to the very end: the thread that waits for signals does, too. */
struct Interrupt {
  std::mutex mutex;
  std::function<void()> action;
};

Interrupt& interrupt() {
  static Interrupt& the_one = *new Interrupt;
  return the_one;
}

/** \brief Waits for one of the signals, tidies up and lets it do its work. */
void awaitSignal(sigset_t signals) {
  int signal = 0;
  if (sigwait(&signals, &signal) != 0)
    return;
  // a second Ctrl-C ends the program at once
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  {
    const std::lock_guard<std::mutex> lock(interrupt().mutex);
    if (interrupt().action)
      interrupt().action();
  }
  removeTemporaries();
  std::raise(signal);
}

/** \brief No file that is opened may come to stand for a standard stream that whoever
 * started the program has closed. */
void occupyStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) {
      // the wrong way round: using it is an error and no silent loss
      const int wrong = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
      [[maybe_unused]] const int opened = open("/dev/null", wrong);
    }
}

} // namespace

void beginProcess() {
  occupyStandardStreams();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current = {};
    // nohup and background jobs have them ignored, and so it stays
    if (sigaction(signal, nullptr, &current) == 0 && current.sa_handler != SIG_IGN)
      sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(awaitSignal, signals).detach();
}

int endProcess(const std::string& name, int code) {
  if (const std::string line = writtenFiles(); !line.empty() && !quiet())
    std::cout << line << '\n';
  const bool bad = std::cout.flush().bad();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && !bad)
    return code;
  std::cerr << name
            << ": cannot write to standard output: the disk is full, or the program "
               "that reads it has gone.\n";
  return code == DONE ? FAILED : code;
}

void setInterruptAction(std::function<void()> action) {
  const std::lock_guard<std::mutex> lock(interrupt().mutex);
  interrupt().action = std::move(action);
}

} // namespace pcl_sq::app
