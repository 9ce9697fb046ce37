// SPDX-License-Identifier: BSD-3-Clause
#include "report/text.h"

#include <cstdint>

namespace pcl_sq::app {

namespace {

/** \brief Length of the UTF-8 character that \a text starts with if it can be shown:
 * neither a control character nor a mark that turns the direction of writing; else 0.
 */
std::size_t shownCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80)
    return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length)
    return 0;
  std::uint32_t code = first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U)
      return 0;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  const std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  const bool control = code < 0xa0 || (code >= 0x2028 && code <= 0x202e) ||
                       (code >= 0x2066 && code <= 0x2069);
  return code < smallest[length] || code > 0x10ffff || surrogate || control ? 0
                                                                            : length;
}

} // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = shownCharacter(text);
    if (shown.size() + length > longest)
      return shown + "...";
    if (length == 0)
      shown += '?';
    else
      shown += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return shown;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t LONGEST = 40; // of a line in a terminal, half
  return "'" + printable(word, LONGEST) + "'";
}

} // namespace pcl_sq::app
