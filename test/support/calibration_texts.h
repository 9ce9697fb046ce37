// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_calibration.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pcl_sq::test {

using Texts = std::vector<CalibrationText>;

inline StereoCalibration loadText(const std::string& text, double unit = 1.0) {
  return StereoCalibration::fromText({{"file", text}}, unit);
}

inline std::string refusalOfTexts(const Texts& texts, double unit = 1.0) {
  try {
    (void)StereoCalibration::fromText(texts, unit);
  } catch (const Exception& e) {
    return e.what();
  }
  return "nothing was refused";
}

inline void expectFormatRefusal(const std::string& text, const std::string& reason) {
  EXPECT_NE(refusalOfTexts({{"file", text}}).find(reason), std::string::npos)
      << "wanted '" << reason << "', got '" << refusalOfTexts({{"file", text}}) << "'";
}

} // namespace pcl_sq::test
