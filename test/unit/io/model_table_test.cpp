// SPDX-License-Identifier: BSD-3-Clause
// The table in the model file.
#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

ModelFile canOnTable() {
  ModelFile file;
  file.model.parts.resize(1);
  file.model.parts[0].semi_axes = {0.03, 0.03, 0.06};
  file.table = {0.0, 0.0, 1.0, -0.75};
  return file;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

} // namespace

TEST(ModelTable, IsWrittenAsVersion3AndReadBack) {
  const std::string text = toJson(canOnTable(), -1);
  EXPECT_NE(text.find("\"version\":3"), std::string::npos);
  ModelFile read;
  std::string why;
  ASSERT_TRUE(fromJson(text, read, &why)) << why;
  EXPECT_EQ(read.table, canOnTable().table);
  EXPECT_FALSE(read.model.parts[0].isTapered());
  EXPECT_EQ(toJson(read, -1), text);
}

TEST(ModelTable, WithoutOneTheOlderVersionsAreWritten) {
  ModelFile file = canOnTable();
  file.table.reset();
  EXPECT_NE(toJson(file, -1).find("\"version\":1"), std::string::npos);
  file.model.parts[0].kx = file.model.parts[0].ky = 0.1;
  EXPECT_NE(toJson(file, -1).find("\"version\":2"), std::string::npos);
}

TEST(ModelTable, TapersStandBesideIt) {
  ModelFile file = canOnTable();
  file.model.parts[0].kx = 0.1;
  file.model.parts[0].ky = 0.2;
  ModelFile read;
  std::string why;
  ASSERT_TRUE(fromJson(toJson(file), read, &why)) << why;
  EXPECT_EQ(read.model.parts[0].kx, 0.1);
  EXPECT_EQ(read.model.parts[0].ky, 0.2);
  EXPECT_EQ(read.table, file.table);
}

TEST(ModelTable, NoPlaneIsRefused) {
  const std::string text = toJson(canOnTable(), -1);
  const std::string good = "\"table\":[0.0,0.0,1.0,-0.75]";
  ASSERT_NE(text.find(good), std::string::npos);
  for (const char* bad : {"\"table\":[0,0,0,1]",
                          "\"table\":[0,0,2,1]",
                          "\"table\":[0,0,1]",
                          "\"table\":\"flat\"",
                          "\"table\":[0,0,1,null]"}) {
    ModelFile read;
    std::string why;
    EXPECT_FALSE(fromJson(replaced(text, good, bad), read, &why)) << bad;
    EXPECT_NE(why.find("table"), std::string::npos) << why;
  }
}
