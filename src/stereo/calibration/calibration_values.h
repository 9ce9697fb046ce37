// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stereo/calibration/calibration_formats.h"
#include "stereo/calibration/calibration_names.h"

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq::detail {

/** \brief What was understood, by meaning and side (0: of the pair). */
struct NamedValues {
  struct Value {
    std::string name;
    cv::Mat matrix;
    std::string text;
  };
  std::map<std::pair<CalibrationMeaning, int>, Value> values;
  std::map<std::string, double> numbers; ///< plain numbers by plainName()
  std::vector<std::string> lenses; ///< fisheyes that values of other names speak of

  cv::Mat matrix(CalibrationMeaning meaning, int side = 0) const;
  /** \brief The first number there is of some names; NaN if there is none. */
  double number(std::initializer_list<const char*> names) const;
  /** \brief Adds a value. \throws pcl_sq::Exception if there is another one */
  void add(CalibrationMeaning meaning, int side, const Value& value);
};

/** \brief All documents as one; of two cameras' files the first is the left one. */
CalibrationDocument joined(const CalibrationDocuments& documents);

/** \brief Values by their meaning. \throws pcl_sq::Exception for what looks like a
 * camera's matrix or distortion under a name that is not known */
NamedValues understand(const CalibrationDocument& document);

} // namespace pcl_sq::detail
