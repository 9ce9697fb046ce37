// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <map>
#include <string>
#include <vector>

namespace pcl_sq::detail {

/** \brief Refuses a calibration. \throws pcl_sq::Exception */
[[noreturn]] void raiseLoad(const std::string& what);

/** \brief One value of a calibration file: text, and numbers where it is made of them.
 */
struct CalibrationEntry {
  std::string text;            ///< as it stands in the file; empty for lists
  std::vector<double> numbers; ///< row by row; empty if one of them is no number
  int rows = 0, cols = 0;      ///< shape of \a numbers

  cv::Mat matrix() const; ///< CV_64F; empty without numbers
};

/** \brief What one file says, whatever its format: values by their path, "a/b" for b
 * inside of a. */
struct CalibrationDocument {
  std::string file; ///< for messages
  std::map<std::string, CalibrationEntry> entries;

  const CalibrationEntry* find(const std::string& path) const;
  /** \brief Adds a value. \throws pcl_sq::Exception if the path is taken already */
  void add(const std::string& path, CalibrationEntry entry);
  /** \brief Whether a path begins so. */
  bool hasPrefix(const std::string& prefix) const;
  /** \brief The entries below a prefix, without it. */
  CalibrationDocument below(const std::string& prefix) const;
};

/** \brief The whole text as a number, whatever the locale. */
bool parseNumber(const std::string& text, double& number);

/** \brief Reads YAML, JSON, XML, INI or lines of "name=value"; which one is told by the
 * text itself. A YAML text may hold several documents.
 * \param[in] file name for messages \throws pcl_sq::Exception */
std::vector<CalibrationDocument> parseCalibrationText(const std::string& text,
                                                      const std::string& file);

} // namespace pcl_sq::detail
