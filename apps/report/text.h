// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace pcl_sq::app {

/** \brief Text of a stranger (a file's name, a word of its contents) as it may stand in
 * a message or in JSON: control characters and bytes that are not UTF-8 become '?',
 * what is longer than \a longest bytes ends in "...". */
std::string printable(std::string_view text, std::size_t longest = 4096);

/** \brief The start of a word of a file in quotation marks: 'abc'. */
std::string quoted(std::string_view word);

} // namespace pcl_sq::app
