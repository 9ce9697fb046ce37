// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pcl_sq::app {

/** \brief What is wrong with a command line, in one sentence: which option, what it
 * wants, what was given and what may have been meant. */
std::string sentenceFor(const CLI::ParseError& error, const CLI::App& cli);

/** \brief Lets no option take another option's name for its value ("-o --mesh"), an
 * empty name for a file, or more values than it has, and no flag take one
 * ("--taper=3"). */
void checkValues(CLI::App& cli);

} // namespace pcl_sq::app
