// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/did_you_mean.h"

#include <algorithm>
#include <cctype>

namespace pcl_sq::app {

namespace {

constexpr std::size_t LONGEST = 64; ///< no name is as long
constexpr std::size_t PREFIX = 3;   ///< letters that are a beginning, not chance

/** \brief Letters and digits alone, in lower case: dashes are soon forgotten. */
std::string bare(const std::string& word) {
  std::string letters;
  for (const char c : word)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      letters += char(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

} // namespace

std::size_t editDistance(const std::string& a, const std::string& b) {
  // optimal string alignment: three rows of the table of Wagner and Fischer
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::string closestName(const std::string& word,
                        const std::vector<std::string>& names) {
  const std::string meant = bare(word);
  if (meant.size() < 2 || meant.size() > LONGEST)
    return {};
  std::string closest;
  std::size_t best = 1 + meant.size() / 3; // a third of the letters may be wrong
  for (const std::string& name : names) {
    const std::string other = bare(name);
    if (other.empty())
      continue;
    std::size_t distance = editDistance(meant, other);
    if (meant.size() >= PREFIX && other.compare(0, meant.size(), meant) == 0)
      distance = std::min<std::size_t>(distance, 1);
    if (distance < best || (distance == best && closest.empty())) {
      best = distance;
      closest = name;
    }
  }
  return closest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& names) {
  const std::string name = closestName(word, names);
  return name.empty() ? std::string() : "; did you mean '" + name + "'?";
}

} // namespace pcl_sq::app
