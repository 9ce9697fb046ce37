// SPDX-License-Identifier: BSD-3-Clause
#include "app.h"

#include "process.h"

#include "pcl_sq/config.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <new>

#include <unistd.h>

namespace pcl_sq::app {

namespace {
bool quiet_requested = false;

/** \brief run() without the care for signals and standard output. */
int runGuarded(int argc,
               char** argv,
               const std::string& name,
               const std::string& description,
               const std::string& examples,
               const std::function<void(CLI::App&)>& configure,
               const std::function<int()>& body) {
  const auto fail = [&name](const char* sentence, ExitCode code) {
    std::cerr << name << ": " << sentence << '\n';
    return int(code);
  };
  // PCL talks of its own accord; the user gets one sentence, from here
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    CLI::App cli(description, name);
    cli.footer("Examples:\n" + examples +
               "\nExit codes: 0 done, 1 ran but failed or found nothing, 2 bad command "
               "line.");
    cli.set_version_flag("--version", name + " (pcl_sq) " PCL_SQ_VERSION);
    cli.add_flag("-q,--quiet", quiet_requested, "No progress, no summary");
    cli.get_formatter()->column_width(34);
    configure(cli);
    cli.allow_config_extras(CLI::config_extras_mode::error);
    try {
      cli.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) { // --help, --version
        cli.exit(error);
        return DONE;
      }
      std::cerr << name << ": " << error.what() << " (see " << name << " --help)\n";
      return BAD_COMMAND_LINE;
    }
    return body();
  } catch (const UsageError& error) {
    return fail(error.what(), BAD_COMMAND_LINE);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory for this input; crop or thin it first.", FAILED);
  } catch (const std::exception& error) {
    return fail(error.what(), FAILED);
  }
}

} // namespace

int run(int argc,
        char** argv,
        const std::string& name,
        const std::string& description,
        const std::string& examples,
        const std::function<void(CLI::App&)>& configure,
        const std::function<int()>& body) {
  beginProcess();
  return endProcess(
      name, runGuarded(argc, argv, name, description, examples, configure, body));
}

bool quiet() {
  return quiet_requested;
}

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(std::max<std::size_t>(total, 1)),
      visible_(!quiet_requested && isatty(STDERR_FILENO)) {
  update(0);
}

Progress::~Progress() {
  if (visible_)
    std::fprintf(stderr, "\r\033[K");
}

void Progress::update(std::size_t done) {
  if (!visible_)
    return;
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
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
