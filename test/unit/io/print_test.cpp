// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/multi_superquadric.h"

#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

using namespace pcl_sq;

namespace {

Superquadric can() {
  Superquadric s;
  s.center = {0.1, -0.05, 0.8};
  s.semi_axes = {0.033, 0.033, 0.06};
  s.epsilon1 = 0.2;
  return s;
}

template <typename Model>
std::string text(const Model& model) {
  std::ostringstream stream;
  stream << model;
  return stream.str();
}

} // namespace

TEST(Print, ASuperquadricIsOneLineWithItsUnits) {
  EXPECT_EQ(text(can()),
            "superquadric at (0.1, -0.05, 0.8) m, semi-axes (0.033, 0.033, 0.06) m, "
            "exponents 0.2 and 1, axes x (1, 0, 0), y (0, 1, 0), z (0, 0, 1)");
}

TEST(Print, AUnionHasALineForEachPart) {
  MultiSuperquadric model;
  EXPECT_EQ(text(model), "0 parts");
  model.parts = {can()};
  EXPECT_EQ(text(model), "1 part\n  0: " + text(can()));
  model.parts.push_back(can());
  EXPECT_EQ(text(model), "2 parts\n  0: " + text(can()) + "\n  1: " + text(can()));
}

TEST(Print, TheStreamsPrecisionIsKeptAndUsed) {
  std::ostringstream stream;
  Superquadric s = can();
  s.center.x() = 1.0 / 3.0;
  stream << std::setprecision(3) << s;
  EXPECT_NE(stream.str().find("(0.333,"), std::string::npos);
  EXPECT_EQ(stream.precision(), 3);
}
