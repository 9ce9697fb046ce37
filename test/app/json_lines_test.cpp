// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_fit --jsonl, its order, failures and interruption.
#include "fit_program.h"
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

extern char** environ;

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

std::string cloudText() {
  std::ostringstream text;
  text << visiblePoints(bottle(), 300, 0.0005).transpose() << "\n";
  return text.str();
}

std::vector<nlohmann::json> linesOf(const std::string& path) {
  std::vector<nlohmann::json> lines;
  std::istringstream text(slurp(path));
  for (std::string line; std::getline(text, line);)
    lines.push_back(nlohmann::json::parse(line));
  return lines;
}

/** \brief A program that runs beside the test. */
class Running {
public:
  explicit Running(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), PCL_SQ_BIN_DIR "/pcl_sq_fit");
    std::vector<char*> argv;
    for (std::string& argument : arguments)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    EXPECT_EQ(posix_spawn(&id_, argv[0], &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  /** \brief Sends a signal and waits. \return the one that ended the program, or 0 */
  int end(int signal) {
    kill(id_, signal);
    int status = 0;
    waitpid(id_, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

private:
  pid_t id_ = 0;
};

/** \brief Waits for a file to have so many lines. \return whether it has */
bool waitForLines(const std::string& path, std::size_t lines) {
  for (int i = 0; i < 3000; ++i) { // half a minute
    const std::string text = slurp(path);
    if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) >= lines)
      return true;
    usleep(10000);
  }
  return false;
}

} // namespace

TEST(JsonLines, ACloudThatFailsHasALineWithItsError) {
  const Folder folder;
  const std::string good = folder.write("good.xyz", cloudText());
  const std::string bad = folder.write("bad.xyz", "no numbers\n");
  const std::string out = folder / "out.jsonl";
  const ProgramRun run =
      runProgram("pcl_sq_fit", {bad, good, bad, "--jsonl", "-o", out});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 2) << run.err;
  EXPECT_EQ(run.out, "wrote " + out + "\n");
  const std::vector<nlohmann::json> lines = linesOf(out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0]["input"]["path"], bad);
  EXPECT_NE(lines[0]["error"].get<std::string>().find("bad.xyz"), std::string::npos);
  EXPECT_EQ(lines[1]["schema"], "pcl_sq/model");
  EXPECT_FALSE(lines[1].contains("error"));
  EXPECT_EQ(lines[2], lines[0]);
}

TEST(JsonLines, EachIsThereAsSoonAsItIsDoneAndStaysWhenTheProgramIsEnded) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
    const Folder folder;
    const std::string good = folder.write("good.xyz", cloudText());
    const std::string never = folder / "never.xyz", out = folder / "out.jsonl";
    ASSERT_EQ(mkfifo(never.c_str(), 0600), 0); // nobody ever writes into it
    Running program({good, good, never, "--threads", "1", "-q", "--jsonl", "-o", out});
    EXPECT_TRUE(waitForLines(out, 2));
    EXPECT_EQ(program.end(signal), signal);
    const std::vector<nlohmann::json> lines = linesOf(out);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[1]["input"]["path"], good);
    EXPECT_EQ(folder.files(), 2u) << "something hidden is left";
  }
}

TEST(JsonLines, WhatWaitsForAnEarlierCloudIsKeptWhenTheProgramIsEnded) {
  const Folder folder;
  const std::string good = folder.write("good.xyz", cloudText());
  const std::string never = folder / "never.xyz", pipe = folder / "pipe.xyz";
  const std::string out = folder / "out.jsonl";
  ASSERT_EQ(mkfifo(never.c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Running program({never, good, pipe, "--threads", "2", "-q", "--jsonl", "-o", out});
  // the second cloud is done once the third is read
  close(open(pipe.c_str(), O_WRONLY));
  EXPECT_EQ(program.end(SIGINT), SIGINT);
  const std::vector<nlohmann::json> lines = linesOf(out);
  ASSERT_GE(lines.size(), 1u);
  EXPECT_EQ(lines[0]["input"]["path"], good);
}

TEST(JsonLines, OneCloudThatNeverEndsHoldsBackAFewOthersOnly) {
  const Folder folder;
  const std::string bad = folder.write("bad.xyz", "no numbers\n");
  const std::string never = folder / "never.xyz", out = folder / "out.jsonl";
  ASSERT_EQ(mkfifo(never.c_str(), 0600), 0);
  std::vector<std::string> arguments(40, bad);
  arguments.insert(arguments.begin(), never);
  arguments.insert(arguments.end(), {"--threads", "2", "-q", "--jsonl", "-o", out});
  Running program(arguments);
  EXPECT_TRUE(waitForLines(out, 40)) << "the others wait for the one that never ends";
  EXPECT_EQ(program.end(SIGTERM), SIGTERM);
  EXPECT_EQ(linesOf(out).size(), 40u);
}

TEST(FitApp, JsonLinesComeInTheOrderOfTheCloudsAndOneBadCloudSpoilsNoOther) {
  const Folder folder;
  const std::string first = folder.write("first.pcd", bottlePcd());
  const std::string last = folder.write("last.pcd", bottlePcd(2000));
  const ProgramRun run =
      runProgram("pcl_sq_fit", {first, folder / "missing.pcd", last, "--jsonl"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 1) << run.err;
  std::istringstream lines(run.out);
  std::string line;
  for (const std::string& path : {first, last}) {
    ASSERT_TRUE(std::getline(lines, line));
    if (path == last) { // the line of the missing cloud is before it
      EXPECT_NE(line.find("\"error\""), std::string::npos) << line;
      ASSERT_TRUE(std::getline(lines, line));
    }
    ModelFile file;
    std::string why;
    ASSERT_TRUE(fromJson(line, file, &why)) << why;
    EXPECT_EQ(file.input_path, path);
  }
  EXPECT_FALSE(std::getline(lines, line));
  EXPECT_EQ(runProgram("pcl_sq_fit", {first, last}).code, 2);
}
