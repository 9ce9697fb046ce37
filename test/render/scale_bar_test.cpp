// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/scale_bar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

using namespace pcl_sq;

TEST(ScaleBar, IsTheLongestRoundLengthThatFits) {
  for (double longest = 1e-5; longest < 1e4; longest *= 1.07) {
    const double length = roundScaleBar(longest).length;
    EXPECT_LE(length, longest * (1 + 1e-9));
    EXPECT_GT(2.5 * length, longest * (1 - 1e-9));
    double leading = length / std::pow(10.0, std::floor(std::log10(length) + 1e-9));
    EXPECT_TRUE(std::abs(leading - 1) < 1e-9 || std::abs(leading - 2) < 1e-9 ||
                std::abs(leading - 5) < 1e-9)
        << length;
  }
}

TEST(ScaleBar, RoundLengthsAreTheirOwnBar) {
  for (const double length : {1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 1.0, 10.0})
    EXPECT_NEAR(roundScaleBar(length).length, length, 1e-12);
}

TEST(ScaleBar, LabelStatesTheLengthInAUnitThatGivesOneOrMore) {
  const std::map<std::string, double> units = {
      {"km", 1e3}, {"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"\xC2\xB5m", 1e-6}};
  for (double longest = 1e-5; longest < 1e4; longest *= 1.3) {
    const ScaleBar bar = roundScaleBar(longest);
    std::istringstream label(bar.label);
    double number = 0.0;
    std::string unit;
    label >> number >> unit;
    ASSERT_EQ(units.count(unit), 1u) << bar.label;
    EXPECT_NEAR(number * units.at(unit), bar.length, 1e-9 * bar.length) << bar.label;
    EXPECT_GE(number, 1.0) << bar.label;
  }
  EXPECT_EQ(roundScaleBar(0.07).label, "5 cm");
  EXPECT_EQ(roundScaleBar(0.0031).label, "2 mm");
  EXPECT_EQ(roundScaleBar(12.0).label, "10 m");
}
