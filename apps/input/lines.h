// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_sq::app {

/** \brief Lines of a text that ends them as Unix, Windows or old Macs do. */
class Lines {
public:
  explicit Lines(std::string_view text) : text_(text) {}

  /** \brief Takes the next line, without its end. \return false after the last one */
  bool next(std::string_view& line);
  /** \brief Number of the line that was taken last, from 1. */
  std::size_t number() const { return number_; }
  /** \brief What follows the line that was taken last. */
  std::string_view rest() const { return text_.substr(at_); }

private:
  std::string_view text_;
  std::size_t at_ = 0, newline_ = 0, number_ = 0;
};

/** \brief Takes the next word between blanks from \a line; empty after the last one. */
std::string_view takeWord(std::string_view& line);

/** \brief Reads the whole word as a number; every usual spelling of "no number" (nan,
 * -nan(ind), 1.#QNAN, null, NA) is NaN. The locale does not matter.
 * \return false if it is anything else */
bool parseNumber(std::string_view word, double& value);

/** \brief Reads the whole word as a count. */
bool parseCount(std::string_view word, std::uint64_t& value);

/** \brief The word with small letters (ASCII). */
std::string lowered(std::string_view word);

/** \brief Throws Failure: "line N: what". */
[[noreturn]] void failInLine(std::size_t line, const std::string& what);

/** \brief Whether bytes behind the last point are the end of a line or padding. */
bool isPadding(std::string_view bytes);

/** \brief What to do about decimal commas. */
extern const char* const DECIMAL_COMMAS;

/** \brief Why a word is no number, for a message: 1,5 has a decimal comma. */
std::string whyNoNumber(std::string_view word);

} // namespace pcl_sq::app
