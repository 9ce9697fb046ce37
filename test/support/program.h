// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace pcl_sq::test {

/** \brief A folder of its own for one test, removed at the end. */
class Folder {
public:
  Folder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "pcl_sq_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /** \brief Writes a file into the folder. \return its path */
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(*this / name, std::ios::binary) << bytes;
    return *this / name;
  }
  /** \brief Number of files in the folder, hidden ones included. */
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      count += entry.is_regular_file();
    return count;
  }

private:
  std::string path_;
};

inline std::string slurp(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/** \brief How a program ended and what it said. */
struct ProgramRun {
  int code = -1; ///< exit code; 128 + signal after a crash
  std::string out, err;
  /** \brief Lines on stderr. */
  int sentences() const {
    int lines = 0;
    for (const char c : err)
      lines += c == '\n';
    return lines;
  }
};

/** \brief Runs one of our programs.
 * \param[in] before shell text in front of it, for example "ulimit -v 500000;" */
inline ProgramRun runProgram(const std::string& name,
                      const std::vector<std::string>& arguments,
                      const std::string& before = "") {
  const Folder folder;
  std::string command = before + " '" PCL_SQ_BIN_DIR "/" + name + "'";
  for (const std::string& argument : arguments)
    command += " '" + argument + "'";
  command += " >'" + (folder / "out") + "' 2>'" + (folder / "err") + "' </dev/null";
  const int status = std::system(command.c_str());
  ProgramRun run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.out = slurp(folder / "out");
  run.err = slurp(folder / "err");
  return run;
}

} // namespace pcl_sq::test
