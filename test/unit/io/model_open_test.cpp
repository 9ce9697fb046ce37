// SPDX-License-Identifier: BSD-3-Clause
// Rims and walls in model files.
#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

ModelFile bowl() {
  ModelFile file;
  Superquadric s;
  s.semi_axes = {0.08, 0.08, 0.06};
  s.rim = 0.1;
  s.wall = 0.004;
  file.model.parts = {s};
  file.statistics.resize(1);
  return file;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

} // namespace

TEST(ModelOpen, RimAndWallComeBackToTheBit) {
  const std::string text = toJson(bowl(), -1);
  EXPECT_NE(text.find("\"version\":3"), std::string::npos);
  ModelFile read;
  std::string why;
  ASSERT_TRUE(fromJson(text, read, &why)) << why;
  EXPECT_EQ(read.model.parts[0].rim, 0.1);
  EXPECT_EQ(read.model.parts[0].wall, 0.004);
  EXPECT_EQ(toJson(read, -1), text);
}

TEST(ModelOpen, OlderVersionsKnowNeither) {
  ModelFile read;
  ASSERT_TRUE(
      fromJson(replaced(toJson(bowl(), -1), "\"version\":3", "\"version\":2"), read));
  EXPECT_TRUE(read.model.parts[0].isPlain());
}

TEST(ModelOpen, BadOnesAreRefusedWithASentence) {
  const std::string text = toJson(bowl(), -1);
  for (const auto& [good, bad, word] :
       {std::array<const char*, 3>{"\"rim\":0.1", "\"rim\":1.5", "rim"},
        {"\"rim\":0.1", "\"rim\":\"high\"", "rim"},
        {"\"rim\":0.1", "\"rim\":[0.1]", "rim"},
        {"\"wall\":0.004", "\"wall\":0.09", "wall"},
        {"\"wall\":0.004", "\"wall\":-1", "wall"},
        {"\"wall\":0.004", "\"wall\":null", "wall"},
        {"\"wall\":0.004", "\"wall\":0.004,\"bend\":[1,0]", "bent"}}) {
    ModelFile read;
    std::string why;
    EXPECT_FALSE(fromJson(replaced(text, good, bad), read, &why)) << bad;
    EXPECT_NE(why.find(word), std::string::npos) << why;
  }
}
