// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/app.h"
#include "input/shape.h"
#include "text.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace pcl_sq::test {

/** \brief The bytes of a number in a file of either order. */
template <typename T>
std::string bytesOf(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian)
    std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/** \brief What the reader says about bytes that it refuses; empty if it reads them. */
inline std::string refusal(const std::string& bytes, const std::string& extension) {
  try {
    (void)app::readShape(bytes, extension);
    return {};
  } catch (const app::Failure& failure) {
    return failure.what();
  }
}

/** \brief Whether a text holds all words. */
inline bool tells(const std::string& text, std::initializer_list<const char*> words) {
  return std::all_of(words.begin(), words.end(), [&](const char* word) {
    return text.find(word) != std::string::npos;
  });
}

} // namespace pcl_sq::test
