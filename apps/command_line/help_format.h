// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pcl_sq::app {

/** \brief Puts each option of a program into its group of --help, wherever it was
 * added. */
void groupOptions(CLI::App& cli);

/** \brief --help in groups, with ranges and defaults, within 80 columns. */
class HelpFormat : public CLI::Formatter {
public:
  std::string make_help(const CLI::App* app,
                        std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_option(const CLI::Option* option, bool positional) const override;
};

} // namespace pcl_sq::app
