// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "util/option_check.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

namespace pcl_sq::detail {

/** \brief The order of members is kept: people read these files. */
using Json = nlohmann::ordered_json;

inline Json vectorToJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/** \brief Deepest nesting that a file may have: ours have six levels, and what walks
 * through a value later calls itself once a level. */
constexpr int DEEPEST_JSON = 64;

/** \brief Parses a stranger's JSON text. \param[out] why what is wrong, in our words
 * \return false if it is not JSON, holds numbers beyond a double, or nests too deep */
template <typename Value>
bool parseJson(const std::string& text, Value& json, std::string* why) {
  bool too_deep = false;
  // what a callback refuses is not kept
  const auto bounded = [&too_deep](int depth, typename Value::parse_event_t, Value&) {
    too_deep = too_deep || depth > DEEPEST_JSON;
    return !too_deep;
  };
  try {
    json = Value::parse(text, bounded);
  } catch (const typename Value::parse_error& error) {
    const auto end = text.begin() + std::ptrdiff_t(std::min(error.byte, text.size()));
    return refuse(why,
                  "not valid JSON at line " +
                      std::to_string(1 + std::count(text.begin(), end, '\n')));
  } catch (const typename Value::exception&) {
    return refuse(why, "not valid JSON: a number is too large");
  }
  if (too_deep)
    return refuse(why,
                  "not valid here: brackets nest deeper than " +
                      std::to_string(DEEPEST_JSON) + " levels");
  return true;
}

} // namespace pcl_sq::detail
