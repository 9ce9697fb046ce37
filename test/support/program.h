// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "folder.h"

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

} // namespace pcl_sq::test
