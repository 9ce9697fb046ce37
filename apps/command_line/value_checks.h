// SPDX-License-Identifier: BSD-3-Clause
// What an option's value may be. A refusal reads on from the option's name: "wants a
// whole number from 0 to 16, not 'x'".
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Largest length or coordinate [m]; beyond, single precision has no shape left.
 */
constexpr double FARTHEST = 1e7;
/** \brief No image has a side as long [px]. */
constexpr int MAX_PIXELS = 1000000;

/** \brief A finite number in plain decimal notation, all of the word. */
bool parseNumber(const std::string& word, double& number);

/** \brief A number from \a low to \a high. */
CLI::Validator number(double low, double high);
/** \brief A number above zero, at most \a high. */
CLI::Validator positiveNumber(double high = FARTHEST);
/** \brief A whole number from \a low to \a high, decimal even with leading zeros. */
CLI::Validator wholeNumber(long long low, long long high);
/** \brief One of some names; a misspelt one is told which was meant. */
CLI::Validator oneOf(std::vector<std::string> names);
/** \brief A file that exists. */
CLI::Validator existingFile();

/** \brief An option that takes one of some names for the values of an enumeration. */
template <typename Enum>
CLI::Option* addChoice(CLI::App& cli,
                       const std::string& name,
                       Enum& value,
                       const std::map<std::string, Enum>& names,
                       const std::string& description) {
  std::vector<std::string> list;
  std::string current;
  for (const auto& [key, choice] : names) {
    list.push_back(key);
    if (choice == value)
      current = key;
  }
  return cli
      .add_option_function<std::string>(
          name,
          [&value, names](const std::string& key) { value = names.at(key); },
          description)
      ->default_str(current)
      ->check(oneOf(list));
}

} // namespace pcl_sq::app
