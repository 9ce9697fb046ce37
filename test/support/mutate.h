// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq::test {

/** \brief Small random changes of a file, the same ones in each run: bytes exchanged,
 * left out and doubled, numbers made extreme, brackets added. */
class Mutator {
public:
  explicit Mutator(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1U) {}

  std::string operator()(std::string text) {
    static const std::vector<std::string> WORDS = {"1e300",
                                                   "-1e-300",
                                                   "nan",
                                                   ".inf",
                                                   "1e999",
                                                   "-0",
                                                   "[",
                                                   "]",
                                                   "{",
                                                   "}",
                                                   "\n",
                                                   ": ",
                                                   ",",
                                                   "\"",
                                                   "<",
                                                   ">",
                                                   "&a",
                                                   "*a",
                                                   "null",
                                                   "\xff",
                                                   "\x01",
                                                   "0",
                                                   "99999999999999999999"};
    for (std::size_t changes = 1 + below(3); changes > 0 && !text.empty(); --changes) {
      const std::size_t at = below(text.size());
      const std::size_t length = 1 + below(8);
      switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), length * 4));
        break;
      case 3:
        text.insert(at, WORDS[below(WORDS.size())]);
        break;
      default: { // a number for a number
        const std::size_t begin = text.find_first_of("0123456789", at);
        if (begin != std::string::npos)
          text.replace(begin,
                       text.find_first_not_of("0123456789.eE+-", begin) - begin,
                       WORDS[below(6)]);
      }
      }
    }
    return text;
  }

private:
  std::size_t below(std::size_t end) {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 7U;
    state_ ^= state_ << 17U;
    return static_cast<std::size_t>(state_ % end);
  }

  std::uint64_t state_;
};

} // namespace pcl_sq::test
