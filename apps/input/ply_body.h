// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/app.h"
#include "input/lines.h"
#include "input/ply_header.h"
#include "report/text.h"

#include <cstdint>

namespace pcl_sq::app {

/** \brief Numbers of the body, one after the other. */
class PlyBody {
public:
  PlyBody(const PlyHeader& header, std::string_view bytes, std::size_t first_line)
      : ascii_(header.format == PlyHeader::Format::TEXT),
        swap_(header.format == PlyHeader::Format::BIG), bytes_(bytes), lines_(bytes),
        first_line_(first_line) {}

  bool ascii() const { return ascii_; }
  bool swap() const { return swap_; }
  std::string_view rest() const { return bytes_; }
  std::string place() const {
    return "line " + std::to_string(first_line_ + lines_.number());
  }

  /** \brief Largest number of things that the rest can hold. */
  std::uint64_t capacity(std::size_t bytes, std::size_t numbers) const {
    if (!ascii_)
      return bytes == 0 ? 0 : bytes_.size() / bytes;
    return numbers == 0 ? 0 : (line_.size() + lines_.rest().size() + 1) / (2 * numbers);
  }

  /** \brief The next number. \return false at the end */
  bool next(Scalar type, double& value) {
    if (!ascii_) {
      const std::size_t size = sizeOf(type);
      if (bytes_.size() < size)
        return false;
      value = decode(bytes_.data(), type, swap_);
      bytes_.remove_prefix(size);
      return true;
    }
    const std::string_view word = nextWord();
    if (!word.empty() && !parseNumber(word, value))
      throw Failure(place() + ": " + whyNoNumber(word));
    return !word.empty();
  }

  std::string_view nextWord() {
    std::string_view word = takeWord(line_);
    while (word.empty() && lines_.next(line_))
      word = takeWord(line_);
    return word;
  }

  void skip(std::size_t bytes) { bytes_.remove_prefix(bytes); }

private:
  bool ascii_, swap_;
  std::string_view bytes_; ///< of a binary file, what is left
  std::string_view line_;  ///< of a text, what is left of a line
  Lines lines_;
  std::size_t first_line_;
};

} // namespace pcl_sq::app
