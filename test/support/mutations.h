// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <string>
#include <vector>

namespace pcl_sq::test {

/** \brief Bytes with a few changes of the kinds that break readers: other bytes,
 * numbers that are too large, missing or doubled pieces and lines. */
inline std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::vector<std::string> words = {"-1",
                                          "0",
                                          "4294967296",
                                          "18446744073709551615",
                                          "99999999999999999999999",
                                          "1e308",
                                          "1e-320",
                                          "nan",
                                          "inf",
                                          "list",
                                          "uchar",
                                          "double",
                                          "x",
                                          "binary",
                                          ",",
                                          ";",
                                          "#",
                                          "\r",
                                          "\n",
                                          std::string(1, '\0'),
                                          std::string(4, '\xff')};
  for (std::size_t change = 0; change < 1 + below(4); ++change) {
    const std::size_t at = below(bytes.size()), length = below(20);
    switch (below(7)) {
    case 0:
      if (!bytes.empty())
        bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(below(bytes.size()), length));
      break;
    case 3:
      bytes.insert(at, words[below(words.size())]);
      break;
    case 4: { // a word or a number for another
      const std::size_t begin = bytes.find_first_of(" \n", at);
      if (begin == std::string::npos)
        break;
      const std::size_t end = bytes.find_first_of(" \n", begin + 1);
      bytes.replace(begin + 1, end - begin - 1, words[below(words.size())]);
      break;
    }
    case 5: { // a line away, or twice
      const std::size_t begin = bytes.find('\n', at);
      if (begin == std::string::npos)
        break;
      const std::string line = bytes.substr(begin, bytes.find('\n', begin + 1) - begin);
      if (below(2) == 0)
        bytes.erase(begin, line.size());
      else
        bytes.insert(begin, line);
      break;
    }
    default:
      bytes.resize(at);
      break;
    }
  }
  return bytes;
}

} // namespace pcl_sq::test
