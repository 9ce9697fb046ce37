// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"

#include "command_line/help_format.h"
#include "command_line/option_rules.h"
#include "command_line/parse_sentences.h"
#include "command_line/process.h"
#include "files/files.h"
#include "report/text.h"

#include "pcl_sq/config.h"
#include "pcl_sq/exception.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <iostream>
#include <mutex>
#include <new>
#include <set>

#include <unistd.h>

namespace pcl_sq::app {

namespace {

bool quiet_requested = false;
std::string program_name = "pcl_sq";

/** \brief A sentence without the place in the library that it comes from. */
std::string withoutPlace(const std::string& sentence) {
  const std::size_t end = sentence.find("] ");
  return sentence.compare(0, 8, "[pcl_sq:") == 0 && end != std::string::npos
             ? sentence.substr(end + 2)
             : sentence;
}

int fail(const std::string& sentence, ExitCode code) {
  std::string shown = printable(sentence);
  if (shown.empty() || (shown.back() != '.' && shown.back() != '?'))
    shown += '.';
  std::cerr << program_name << ": " << shown << '\n';
  return code;
}

/** \brief What all programs do to their options once these are added. */
void finishOptions(CLI::App& cli) {
  cli.allow_config_extras(CLI::config_extras_mode::error);
  groupOptions(cli);
  checkValues(cli);
}

bool isImage(const std::string& path) {
  const std::string ending = extensionOf(path);
  for (const char* image :
       {".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".tif", ".tiff"})
    if (ending == image)
      return true;
  return false;
}

/** \brief The words from the last to the first, as CLI11 takes them. --calib has one
 * file or two: where an image follows the first, the images come before. */
std::vector<std::string> inTurn(std::vector<std::string> words) {
  const auto calib = std::find_if(words.begin(), words.end(), [](const auto& word) {
    return word == "--calib" || word.compare(0, 8, "--calib=") == 0;
  });
  const std::ptrdiff_t own = calib != words.end() && *calib == "--calib" ? 2 : 1;
  if (words.end() - calib > own && isImage(*(calib + own)))
    std::rotate(calib, calib + own, words.end());
  std::reverse(words.begin(), words.end());
  return words;
}

/** \brief Reads the command line. \return whether there is work to do */
bool parse(CLI::App& cli, int argc, char** argv, int& code) {
  try {
    cli.parse(inTurn({argv + 1, argv + argc}));
    checkOptionRules(cli);
    return true;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) // --help, --version
      code = cli.exit(error);
    else
      code = fail(sentenceFor(error, cli) + " (see " + program_name + " --help)",
                  BAD_COMMAND_LINE);
  }
  return false;
}

/** \brief run() without the care for signals and standard output. */
int runGuarded(int argc,
               char** argv,
               const std::string& name,
               const std::string& description,
               const std::string& examples,
               const std::function<void(CLI::App&)>& configure,
               const std::function<int()>& body) {
  program_name = name;
  // PCL talks of its own accord; the library's own words come with its results
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    CLI::App cli(description, name);
    cli.footer("Examples:\n" + examples +
               "\nExit codes: 0 done, 1 ran but failed or found nothing, 2 bad command "
               "line.");
    cli.set_version_flag(
        "--version", name + " (pcl_sq) " PCL_SQ_VERSION, "The version, and exit");
    cli.set_help_flag("-h,--help", "This text, and exit");
    cli.add_flag("-q,--quiet", quiet_requested, "No progress, no notes, no summary");
    cli.formatter(std::make_shared<HelpFormat>());
    configure(cli);
    finishOptions(cli);
    int code = DONE;
    return parse(cli, argc, argv, code) ? body() : code;
  } catch (const UsageError& error) {
    return fail(error.what(), BAD_COMMAND_LINE);
  } catch (const std::exception& error) {
    return fail(sentenceOf(error), FAILED);
  }
}

} // namespace

std::string sentenceOf(const std::exception& error) {
  if (dynamic_cast<const Failure*>(&error) != nullptr ||
      dynamic_cast<const UsageError*>(&error) != nullptr ||
      dynamic_cast<const Exception*>(&error) != nullptr)
    return withoutPlace(error.what());
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
      dynamic_cast<const std::length_error*>(&error) != nullptr)
    return "not enough memory for this input; crop or thin it first.";
  return "this input was too much for the program, which is an error of ours; please "
         "report it with the command line and the input.";
}

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

void parseWords(const std::string& name,
                const std::function<void(CLI::App&)>& configure,
                std::vector<std::string> words) {
  if (words.empty()) // every default stays; making the options takes longer than a call
    return;
  CLI::App cli("", name);
  configure(cli);
  finishOptions(cli);
  try {
    cli.parse(inTurn(std::move(words)));
  } catch (const CLI::ParseError& error) {
    throw UsageError(sentenceFor(error, cli));
  }
  checkOptionRules(cli);
}

bool quiet() {
  return quiet_requested;
}

void note(const std::string& sentence, const std::string& first) {
  static std::mutex mutex;
  static std::set<std::string> told;
  const std::lock_guard<std::mutex> lock(mutex);
  if (quiet_requested || !told.insert(sentence).second)
    return;
  if (isatty(STDERR_FILENO) != 0) // a stage may stand on the line
    std::cerr << "\r\033[K";
  std::cerr << program_name
            << ": note: " << (first.empty() ? "" : printable(first) + ": ")
            << printable(sentence) << ".\n";
}

} // namespace pcl_sq::app
