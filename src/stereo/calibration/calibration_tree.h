// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::detail {

/** \brief The common shape of YAML, JSON and XML. */
struct CalibrationTree {
  enum Kind { SCALAR, LIST, MAP } kind = SCALAR;
  std::string text;
  std::vector<std::pair<std::string, CalibrationTree>> children; ///< lists: no names

  const CalibrationTree* child(const std::string& name) const;
};

// The documents of a text; nesting and repetition are bounded, and what is wrong is a
// pcl_sq::Exception that names the file and the line.
std::vector<CalibrationTree> parseYaml(const std::string& text,
                                       const std::string& file);
CalibrationTree parseJsonTree(const std::string& text, const std::string& file);
CalibrationTree parseXml(const std::string& text, const std::string& file);

} // namespace pcl_sq::detail
