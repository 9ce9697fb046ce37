// SPDX-License-Identifier: BSD-3-Clause
// Where the picture is made: with no display, a dead one, none to start, many at once.
#include "pcl_sq/exception.h"
#include "pcl_sq/visualization/snapshot_renderer.h"
#include "visualization/display/private_xvfb.h"

#include "environment_variable.h"
#include "folder.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

using namespace pcl_sq;
using test::EnvironmentVariable;

namespace {

SnapshotRenderer ballOnDisplay() {
  SnapshotOptions options;
  options.width = options.height = 64;
  SnapshotRenderer renderer(options);
  MultiSuperquadric ball;
  ball.parts.resize(1);
  renderer.addModel(ball);
  return renderer;
}

bool showsABall(const SnapshotImage& image) {
  const Color paper{255, 255, 255};
  return image.at(32, 32) != paper && image.at(0, 0) == paper;
}

/** \brief State and parent in the kernel's table of processes; '-' if it is not there.
 */
std::pair<char, pid_t> entryOf(const std::filesystem::path& process) {
  std::ifstream stat(process / "stat");
  pid_t pid = 0, parent = 0;
  std::string name;
  char state = '-';
  stat >> pid >> name >> state >> parent;
  return {state, parent};
}

/** \brief An ended process may stay in the table where nobody asks for its result. */
bool isRunning(pid_t process) {
  const char state = entryOf("/proc/" + std::to_string(process)).first;
  return state != '-' && state != 'Z' && state != 'X';
}

/** \brief Processes that a process has started, once there are any. */
std::vector<pid_t> waitForChildrenOf(pid_t parent) {
  std::vector<pid_t> children;
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (children.empty() && std::chrono::steady_clock::now() < limit)
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
      if (entryOf(entry.path()).second == parent)
        children.push_back(std::stoi(entry.path().filename()));
  return children;
}

} // namespace

TEST(Display, NoneIsNeeded) {
  const EnvironmentVariable none("DISPLAY", nullptr);
  EXPECT_TRUE(showsABall(ballOnDisplay().render()));
}

TEST(Display, OneThatDoesNotAnswerIsReplaced) {
  for (const char* name : {":31999", "", ":", "no display", "nosuchhost.invalid:0"}) {
    const EnvironmentVariable dead("DISPLAY", name);
    EXPECT_TRUE(showsABall(ballOnDisplay().render())) << "'" << name << "'";
  }
}

TEST(Display, OneThatAnswersIsUsedAndNoOtherStarted) {
  const PrivateXvfb server;
  const EnvironmentVariable alive("DISPLAY", server.name().c_str());
  // a second Xvfb could not be found
  const EnvironmentVariable nowhere("PATH", "/nonexistent");
  EXPECT_TRUE(showsABall(ballOnDisplay().render()));
}

TEST(Display, WithoutAnyTheSentenceNamesTheCure) {
  const EnvironmentVariable none("DISPLAY", nullptr);
  const EnvironmentVariable nowhere("PATH", "/nonexistent");
  try {
    ballOnDisplay().render();
    FAIL() << "a picture without a display";
  } catch (const Exception& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("apt-get install xvfb"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
}

TEST(Display, AServerThatEndsAtOnceIsAnErrorAndNotAHang) {
  const test::Folder folder;
  std::ofstream(folder / "Xvfb") << "#!/bin/sh\nexit 1\n";
  std::filesystem::permissions(folder / "Xvfb", std::filesystem::perms::owner_all);
  const EnvironmentVariable none("DISPLAY", nullptr);
  const EnvironmentVariable broken("PATH", (folder / "").c_str());
  EXPECT_THROW(ballOnDisplay().render(), Exception);
}

TEST(Display, PrivateServersEndWithTheirPictureAndLeaveNoZombie) {
  const EnvironmentVariable none("DISPLAY", nullptr);
  ballOnDisplay().render();
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(Display, PrivateServersDoNotMeet) {
  {
    const PrivateXvfb a, b, c;
    EXPECT_EQ((std::set<std::string>{a.name(), b.name(), c.name()}).size(), 3u);
  }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a server is left behind";
}

TEST(Display, ManyProcessesMayTakePicturesAtOnce) {
  const EnvironmentVariable none("DISPLAY", nullptr);
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    const pid_t child = fork();
    if (child == 0)
      _exit(showsABall(ballOnDisplay().render()) ? 0 : 1);
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
}

TEST(Display, ManyThreadsMayTakePicturesAtOnce) {
  const EnvironmentVariable none("DISPLAY", nullptr);
  std::vector<int> seen(4, 0);
  std::vector<std::thread> threads;
  for (int& result : seen)
    threads.emplace_back(
        [&result] { result = showsABall(ballOnDisplay().render()) ? 1 : 0; });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(seen, std::vector<int>(4, 1));
}

TEST(Display, AServerEndsWhenItsProgramIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    const EnvironmentVariable none("DISPLAY", nullptr);
    for (;;)
      ballOnDisplay().render();
  }
  const std::vector<pid_t> servers = waitForChildrenOf(child);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_FALSE(servers.empty());
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (isRunning(servers.front()) && std::chrono::steady_clock::now() < limit)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(isRunning(servers.front()));
}
