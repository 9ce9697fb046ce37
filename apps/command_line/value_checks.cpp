// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/value_checks.h"

#include "command_line/did_you_mean.h"
#include "report/text.h"

#include <charconv>
#include <cmath>
#include <filesystem>

namespace pcl_sq::app {

namespace {

/** \brief The number as a person writes it: 0.05, 1e7. */
std::string written(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", number);
  return text;
}

std::string range(const std::string& low, const std::string& high) {
  return low + " to " + high;
}

/** \brief A range as --help shows it: one that only keeps nonsense out says nothing. */
template <typename Number>
std::string shownRange(Number low, Number high, const std::string& written) {
  return low == -high || double(high) >= FARTHEST ? std::string() : written;
}

template <typename Check>
CLI::Validator validator(const std::string& description, const Check& check) {
  return CLI::Validator(check, description);
}

} // namespace

bool parseNumber(const std::string& word, double& number) {
  const char* begin = word.c_str();
  const char* end = begin + word.size();
  if (begin != end && *begin == '+') // from_chars knows no plus
    ++begin;
  if (begin == end || *begin == '+' || (begin != word.c_str() && *begin == '-'))
    return false;
  const auto [rest, error] = std::from_chars(begin, end, number);
  return error == std::errc() && rest == end && std::isfinite(number);
}

CLI::Validator number(double low, double high) {
  const std::string wanted = range(written(low), written(high));
  return validator(shownRange(low, high, wanted), [=](std::string& word) {
    double value = 0.0;
    if (parseNumber(word, value) && value >= low && value <= high)
      return std::string();
    return "wants a number from " + wanted + ", not " + app::quoted(word);
  });
}

CLI::Validator positiveNumber(double high) {
  const std::string shown =
      high < FARTHEST ? "above 0, at most " + written(high) : "above 0";
  return validator(shown, [=](std::string& word) {
    double value = 0.0;
    if (parseNumber(word, value) && value > 0.0 && value <= high)
      return std::string();
    return "wants a number above 0 and at most " + written(high) + ", not " +
           app::quoted(word);
  });
}

CLI::Validator wholeNumber(long long low, long long high) {
  const std::string wanted = range(std::to_string(low), std::to_string(high));
  return validator(shownRange(low, high, wanted), [=](std::string& word) {
    const std::size_t plus = !word.empty() && word[0] == '+' ? 1 : 0;
    long long value = 0;
    const char* end = word.c_str() + word.size();
    const auto [rest, error] = std::from_chars(word.c_str() + plus, end, value);
    if (error != std::errc() || rest != end || value < low || value > high ||
        (plus == 1 && word[1] == '-'))
      return "wants a whole number from " + wanted + ", not " + app::quoted(word);
    word = std::to_string(value); // "010" is ten, not eight
    return std::string();
  });
}

CLI::Validator oneOf(std::vector<std::string> names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : "|") + name;
  return validator(list, [names = std::move(names)](std::string& word) {
    std::string wanted;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == word)
        return std::string();
      wanted += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
    }
    return "wants " + wanted + ", not " + app::quoted(word) + didYouMean(word, names);
  });
}

CLI::Validator existingFile() {
  return validator("", [](std::string& path) {
    std::error_code error;
    if (path.empty()) // such as a variable of the shell
      return std::string("wants a file, not an empty name");
    if (std::filesystem::is_directory(path, error))
      return "wants a file, but '" + printable(path) + "' is a folder";
    if (std::filesystem::is_character_file(path, error) && path != "/dev/null" &&
        path != "/dev/stdin")
      return "wants a file, but '" + printable(path) + "' is a device";
    if (!std::filesystem::exists(path, error))
      return "wants a file that exists, but there is no '" + printable(path) + "'";
    return std::string();
  });
}

} // namespace pcl_sq::app
