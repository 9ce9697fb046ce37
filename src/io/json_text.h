// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace pcl_sq::detail {

/** \brief Deepest nesting that a file may have: ours have six levels, and what walks
 * through a value later calls itself once a level. */
constexpr int DEEPEST_JSON = 64;

/** \brief Parses a stranger's JSON text. \param[out] why what is wrong, in our words
 * \return false if it is not JSON, holds numbers beyond a double, or nests too deep */
template <typename Json>
bool parseJson(const std::string& text, Json& json, std::string* why) {
  const auto fail = [why](const std::string& reason) {
    if (why)
      *why = reason;
    return false;
  };
  bool too_deep = false;
  // what a callback refuses is not kept
  const auto bounded = [&too_deep](int depth, typename Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > DEEPEST_JSON;
    return !too_deep;
  };
  try {
    json = Json::parse(text, bounded);
  } catch (const typename Json::parse_error& error) {
    const auto end = text.begin() + std::ptrdiff_t(std::min(error.byte, text.size()));
    return fail("not valid JSON at line " +
                std::to_string(1 + std::count(text.begin(), end, '\n')));
  } catch (const typename Json::exception&) {
    return fail("not valid JSON: a number is too large");
  }
  if (too_deep)
    return fail("not valid here: brackets nest deeper than " +
                std::to_string(DEEPEST_JSON) + " levels");
  return true;
}

} // namespace pcl_sq::detail
