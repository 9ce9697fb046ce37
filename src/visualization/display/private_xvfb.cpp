// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/display/private_xvfb.h"

#include "pcl_sq/exception.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace pcl_sq {
namespace {

/// A machine under heavy load needs many seconds to start the server.
constexpr std::chrono::seconds START_LIMIT{60};
constexpr int SERVERS_PIPE = 3; ///< descriptor that the server writes its number to

[[noreturn]] void fail(const std::string& reason) {
  throw Exception(
      "[pcl_sq::SnapshotRenderer] no X display answers and a private one "
      "cannot be started: " +
      reason +
      "; install Xvfb (Debian: apt-get install xvfb libgl1-mesa-dri) or set "
      "DISPLAY.");
}

/** \brief Both ends of a pipe, closed at the end. */
struct Pipe {
  int read_end = -1, write_end = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      fail(std::generic_category().message(errno));
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close(read_end);
    closeWriteEnd();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void closeWriteEnd() {
    if (write_end >= 0)
      close(write_end);
    write_end = -1;
  }
};

pid_t spawnServer(const Pipe& pipe) {
  // tiny screen: pictures are rendered into buffers of their own
  const char* const arguments[] = {"Xvfb",
                                   "-displayfd",
                                   "3",
                                   "-screen",
                                   "0",
                                   "64x64x24",
                                   "-nolisten",
                                   "tcp",
                                   "-terminate",
                                   "+extension",
                                   "GLX",
                                   nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe.write_end, SERVERS_PIPE);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);

  // the program's signal settings are not the server's, nor is its terminal's Ctrl-C
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                               POSIX_SPAWN_SETPGROUP);

  pid_t pid = -1;
  const int error = posix_spawnp(&pid,
                                 "Xvfb",
                                 &actions,
                                 &attributes,
                                 const_cast<char* const*>(arguments),
                                 environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    fail(std::string("Xvfb: ") + std::generic_category().message(error));
  return pid;
}

/** \brief The line the server writes once it accepts clients; empty if it never does.
 */
std::string readDisplayNumber(int descriptor) {
  const auto limit = std::chrono::steady_clock::now() + START_LIMIT;
  std::string number;
  while (number.empty() || number.back() != '\n') {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        limit - std::chrono::steady_clock::now());
    pollfd waiting{descriptor, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR)
      continue;
    char byte = 0;
    if (ready <= 0 || left.count() <= 0 || read(descriptor, &byte, 1) != 1)
      return {};
    number += byte;
  }
  number.pop_back();
  return number;
}

} // namespace

PrivateXvfb::PrivateXvfb() {
  Pipe pipe;
  pid_ = spawnServer(pipe);
  pipe.closeWriteEnd();
  const std::string number = readDisplayNumber(pipe.read_end);
  if (number.empty()) {
    stop();
    fail("Xvfb ends without accepting clients (run it by hand to see why)");
  }
  name_ = ":" + number;
}

PrivateXvfb::~PrivateXvfb() {
  stop();
}

void PrivateXvfb::stop() {
  // asked to end, it takes its lock file along; a hanging server is not waited for
  kill(pid_, SIGTERM);
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  pid_t ended = 0;
  while ((ended = waitpid(pid_, nullptr, WNOHANG)) == 0 &&
         std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (ended == 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

} // namespace pcl_sq
