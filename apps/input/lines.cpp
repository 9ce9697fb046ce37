// SPDX-License-Identifier: BSD-3-Clause
#include "input/lines.h"

#include "command_line/app.h"
#include "report/text.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace pcl_sq::app {

namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

/** \brief Words that programs write where there is no number. */
bool isNoNumber(const std::string& word) {
  for (const char* spelling : {"null", "none", "na", "n/a", "nil", "#n/a", "-"})
    if (word == spelling)
      return true;
  // old Windows: 1.#QNAN, -1.#IND, 1.#INF, 1.#SNAN0
  return word.find(".#") != std::string::npos && word.size() < 12 &&
         word.find_first_not_of("-+0123456789.#qnansidfr") == std::string::npos;
}

} // namespace

bool Lines::next(std::string_view& line) {
  if (at_ >= text_.size())
    return false;
  if (newline_ < at_ || number_ == 0) { // looked for once for each: never quadratic
    newline_ = text_.find('\n', at_);
    if (newline_ == std::string_view::npos)
      newline_ = text_.size();
  }
  line = text_.substr(at_, newline_ - at_);
  const std::size_t back = line.find('\r');
  if (back == std::string_view::npos || back + 1 == line.size())
    at_ = newline_ + 1;
  else
    at_ += back + 1; // a Mac's line
  line = line.substr(0, back);
  at_ = std::min(at_, text_.size());
  ++number_;
  return true;
}

std::string_view takeWord(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin]))
    ++begin;
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end]))
    ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool parseNumber(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
    word.remove_prefix(1);
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end == last && error == std::errc())
    return true;
  if (end == last && error == std::errc::result_out_of_range) {
    const bool small = word.find("e-") != std::string_view::npos ||
                       word.find("E-") != std::string_view::npos;
    value = small ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  constexpr std::size_t LONGEST = 12;
  if (word.empty() || word.size() > LONGEST || !isNoNumber(lowered(word)))
    return false;
  value = std::numeric_limits<double>::quiet_NaN();
  return true;
}

bool parseCount(std::string_view word, std::uint64_t& value) {
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, value);
  return end == last && error == std::errc();
}

std::string lowered(std::string_view word) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return small;
}

bool isPadding(std::string_view bytes) {
  return std::all_of(
      bytes.begin(), bytes.end(), [](char c) { return isBlank(c) || c == '\0'; });
}

const char* const DECIMAL_COMMAS = "decimal commas; write points (1.5 instead of 1,5)";

std::string whyNoNumber(std::string_view word) {
  const std::size_t comma = word.find(',');
  double whole = 0.0;
  std::uint64_t digits = 0;
  const bool decimal = comma != std::string_view::npos &&
                       parseNumber(word.substr(0, comma), whole) &&
                       word.substr(comma + 1).find_first_not_of("0123456789eE+-") ==
                           std::string_view::npos &&
                       parseCount(word.substr(comma + 1, 1), digits);
  return decimal ? DECIMAL_COMMAS : quoted(word) + " is no number";
}

void failInLine(std::size_t line, const std::string& what) {
  throw Failure("line " + std::to_string(line) + ": " + what);
}

} // namespace pcl_sq::app
