// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Exit codes of every program. */
enum ExitCode { DONE = 0, FAILED = 1, BAD_COMMAND_LINE = 2 };

/** \brief Something the user must be told in one sentence; the program ends with 1. */
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** \brief A contradiction among options found after parsing; the program ends with 2.
 */
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** \brief What an error tells the user, in one sentence: errors of our own as they are,
 * those of other libraries as what they are to the user. */
std::string sentenceOf(const std::exception& error);

/** \brief The frame of a main(): adds --version and -q, parses, refuses options without
 * effect, runs, and turns every error into one sentence on stderr and an exit
 * code; at the end it tells which files were written.
 * \param[in] configure adds the program's own options
 * \param[in] body the work; returns an exit code */
int run(int argc,
        char** argv,
        const std::string& name,
        const std::string& description,
        const std::string& examples,
        const std::function<void(CLI::App&)>& configure,
        const std::function<int()>& body);

/** \brief Reads options that no command line brought, with a program's rules: for the
 * Python module. \param[in] name the program whose options they are \throw UsageError
 */
void parseWords(const std::string& name,
                const std::function<void(CLI::App&)>& configure,
                std::vector<std::string> words);

/** \brief Whether -q/--quiet was given. */
bool quiet();

/** \brief Tells the user something that is no failure, such as a fall-back: one line on
 * stderr, each sentence once; silent with -q. May be called from any thread.
 * \param[in] first where it holds, of several files; the others are not told again */
void note(const std::string& sentence, const std::string& first = {});

/** \brief The stage of long work on stderr, such as "fitting ..."; silent when stderr
 * is no terminal or -q was given. Gone when the object is. May be called from any
 * thread. */
class StageLine {
public:
  StageLine() = default;
  ~StageLine() { clear(); }
  StageLine(const StageLine&) = delete;
  StageLine& operator=(const StageLine&) = delete;
  /** \param[in] share done of the stage, 0 to 1 */
  void show(const std::string& stage, double share = 0.0);
  void clear();

private:
  std::string shown_;
};

/** \brief A progress bar on stderr; silent when stderr is no terminal or -q was given.
 */
class Progress {
public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /** \brief Marks \a done of the total as finished; may be called from any thread. */
  void update(std::size_t done);

private:
  std::string what_;
  std::size_t total_;
  bool visible_;
};

} // namespace pcl_sq::app
