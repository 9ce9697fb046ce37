// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace pcl_sq::test {

/** \brief How a program ended and what it said. */
struct ProgramRun {
  int code = -1; ///< exit code; 128 + signal after a crash
  std::string out, err;
  /** \brief Lines on stderr that are no notes. */
  int sentences() const {
    std::istringstream lines(err);
    std::string line;
    int count = 0;
    while (std::getline(lines, line))
      count += line.find(": note: ") == std::string::npos ? 1 : 0;
    return count;
  }
};

/** \brief Runs one of our programs.
 * \param[in] before shell text in front of it, for example "ulimit -v 500000;"
 * \param[in] input the file that is its standard input */
inline ProgramRun runProgram(const std::string& name,
                             const std::vector<std::string>& arguments,
                             const std::string& before = "",
                             const std::string& input = "/dev/null") {
  const Folder folder;
  std::string command = before + " '" PCL_SQ_BIN_DIR "/" + name + "'";
  for (const std::string& argument : arguments)
    command += " '" + argument + "'";
  command +=
      " >'" + (folder / "out") + "' 2>'" + (folder / "err") + "' <'" + input + "'";
  const int status = std::system(command.c_str());
  ProgramRun run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = slurp(folder / "out");
  run.err = slurp(folder / "err");
  return run;
}

/** \brief The program refuses: exit code, one sentence with a word in it, no output.
 * \param[in] folder in which nothing new is left */
inline void expectRefusal(const std::string& name,
                          const std::vector<std::string>& arguments,
                          int code,
                          const std::string& word = "",
                          const Folder* folder = nullptr) {
  const std::size_t files = folder ? folder->files() : 0;
  const ProgramRun run = runProgram(name, arguments);
  std::string line;
  for (const std::string& argument : arguments)
    line += argument + " ";
  EXPECT_EQ(run.code, code) << line << run.err;
  EXPECT_EQ(run.sentences(), 1) << line << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << line << run.err;
  EXPECT_TRUE(run.out.empty()) << line << run.out;
  EXPECT_EQ(folder ? folder->files() : 0, files) << line << "something was left behind";
}

} // namespace pcl_sq::test
