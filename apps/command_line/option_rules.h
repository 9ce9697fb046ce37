// SPDX-License-Identifier: BSD-3-Clause
// Which options go with which: what has no effect is refused instead of ignored.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What a command line and its --config say. */
class CommandLine {
public:
  explicit CommandLine(const CLI::App& cli) : cli_(cli) {}
  std::string program() const { return cli_.get_name(); }
  /** \brief Whether the user gives the option. */
  bool given(const std::string& option) const;
  /** \brief Its last value, the default where it is not given, "" without one. */
  std::string value(const std::string& option) const;
  /** \brief Its values as they were given. */
  std::vector<std::string> values(const std::string& option) const;

private:
  const CLI::App& cli_;
};

/** \brief Options that have an effect under a condition only. */
struct OptionRule {
  std::vector<std::string> programs; ///< that it is about; empty: all that have them
  std::vector<const char*> options;
  std::function<bool(const CommandLine&)> holds;
  const char*
      cure; ///< "it goes with ...": what to do where the condition does not hold
};

/** \brief All rules of all programs. */
const std::vector<OptionRule>& optionRules();

/** \brief Decomposition that the command line asks for: "parts", "prisms" or "none". */
std::string decompositionOf(const CommandLine& line);

/** \brief Whether the paper's chain is asked for, by name or by one of its options. */
bool asksForPaper(const CommandLine& line);

/** \brief Refuses options that would have no effect. \throw UsageError */
void checkOptionRules(const CLI::App& cli);

} // namespace pcl_sq::app
