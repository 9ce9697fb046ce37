// SPDX-License-Identifier: BSD-3-Clause
// Bends in model files.
#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace pcl_sq;

namespace {

ModelFile banana() {
  ModelFile file;
  Superquadric s;
  s.semi_axes = {0.016, 0.016, 0.09};
  s.bend = 10.0;
  s.bend_angle = 0.5;
  file.model.parts = {s};
  file.statistics.resize(1);
  return file;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

} // namespace

TEST(ModelBent, BendComesBackToTheBitAndIsPrinted) {
  const std::string text = toJson(banana(), -1);
  EXPECT_NE(text.find("\"version\":3"), std::string::npos);
  EXPECT_NE(text.find("\"bend\":[10.0,0.5]"), std::string::npos);
  ModelFile read;
  std::string why;
  ASSERT_TRUE(fromJson(text, read, &why)) << why;
  EXPECT_EQ(read.model.parts[0].bend, 10.0);
  EXPECT_EQ(read.model.parts[0].bend_angle, 0.5);
  EXPECT_EQ(toJson(read, -1), text);
  std::ostringstream printed;
  printed << read.model.parts[0];
  EXPECT_NE(printed.str().find("bend 10 per m"), std::string::npos) << printed.str();
}

TEST(ModelBent, BadOnesAreRefusedWithASentence) {
  const std::string text = toJson(banana(), -1), good = "\"bend\":[10.0,0.5]";
  for (const auto& [bad, words] : {std::pair{"\"bend\":[40.0,0.5]", "meets itself"},
                                   {"\"bend\":[10.0]", "2 numbers"},
                                   {"\"bend\":[10.0,\"x\"]", "2 numbers"},
                                   {"\"bend\":[10.0,0.5],\"wall\":0.004", "wall"},
                                   {"\"bend\":[10.0,0.5],\"rim\":0.5", "rim"}}) {
    ModelFile read;
    std::string why;
    EXPECT_FALSE(fromJson(replaced(text, good, bad), read, &why)) << bad;
    EXPECT_NE(why.find(words), std::string::npos) << why;
  }
}
