// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace pcl_sq::test {

/** \brief A text with every place of another text in it changed; there must be one. */
inline std::string
replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
  for (std::size_t i = text.find(what); i != std::string::npos;
       i = text.find(what, i + by.size()))
    text.replace(i, what.size(), by);
  return text;
}

/** \brief How often a word is in a text. */
inline std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
    ++n;
  return n;
}

} // namespace pcl_sq::test
