// SPDX-License-Identifier: BSD-3-Clause
// What a model file may hold since versions 2 and 3: tapers, rims, walls, bends, a
// table.
#include "text.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace pcl_sq;
using test::replaced;

namespace {

ModelFile fileOf(const Superquadric& s) {
  ModelFile file;
  file.model.parts = {s};
  file.statistics.resize(1);
  return file;
}

ModelFile banana() {
  Superquadric s;
  s.semi_axes = {0.016, 0.016, 0.09};
  s.bend = 10.0;
  s.bend_angle = 0.5;
  return fileOf(s);
}

ModelFile bowl() {
  Superquadric s;
  s.semi_axes = {0.08, 0.08, 0.06};
  s.rim = 0.1;
  s.wall = 0.004;
  return fileOf(s);
}

ModelFile canOnTable() {
  Superquadric s;
  s.semi_axes = {0.03, 0.03, 0.06};
  ModelFile file = fileOf(s);
  file.table = {0.0, 0.0, 1.0, -0.75};
  return file;
}

/** \brief What a file says once it was written and read; the same text again. */
ModelFile readBack(const ModelFile& file, const std::string& version) {
  const std::string text = toJson(file, -1);
  EXPECT_NE(text.find("\"version\":" + version), std::string::npos) << text;
  ModelFile read;
  std::string why;
  EXPECT_TRUE(fromJson(text, read, &why)) << why;
  EXPECT_EQ(toJson(read, -1), text);
  return read;
}

void expectRefusal(const ModelFile& file,
                   const std::string& good,
                   const std::string& bad,
                   const std::string& word) {
  ModelFile read;
  std::string why;
  EXPECT_FALSE(fromJson(replaced(toJson(file, -1), good, bad), read, &why)) << bad;
  EXPECT_NE(why.find(word), std::string::npos) << why;
}

} // namespace

TEST(ModelVersions, BendComesBackToTheBitAndIsPrinted) {
  const ModelFile read = readBack(banana(), "3");
  EXPECT_EQ(read.model.parts[0].bend, 10.0);
  EXPECT_EQ(read.model.parts[0].bend_angle, 0.5);
  std::ostringstream printed;
  printed << read.model.parts[0];
  EXPECT_NE(printed.str().find("bend 10 per m"), std::string::npos) << printed.str();
}

TEST(ModelVersions, RimAndWallComeBackToTheBit) {
  const ModelFile read = readBack(bowl(), "3");
  EXPECT_EQ(read.model.parts[0].rim, 0.1);
  EXPECT_EQ(read.model.parts[0].wall, 0.004);
}

TEST(ModelVersions, TableComesBackToTheBitBesideTapers) {
  ModelFile file = canOnTable();
  EXPECT_EQ(readBack(file, "3").table, file.table);
  EXPECT_FALSE(readBack(file, "3").model.parts[0].isTapered());
  file.model.parts[0].kx = 0.1;
  file.model.parts[0].ky = 0.2;
  const ModelFile read = readBack(file, "3");
  EXPECT_EQ(read.model.parts[0].kx, 0.1);
  EXPECT_EQ(read.model.parts[0].ky, 0.2);
  EXPECT_EQ(read.table, file.table);
}

TEST(ModelVersions, TheOldestThatHoldsTheModelIsWritten) {
  ModelFile file = canOnTable();
  file.table.reset();
  readBack(file, "1");
  file.model.parts[0].kx = file.model.parts[0].ky = 0.1;
  readBack(file, "2");
}

TEST(ModelVersions, OlderOnesKnowNeitherRimNorWall) {
  ModelFile read;
  ASSERT_TRUE(
      fromJson(replaced(toJson(bowl(), -1), "\"version\":3", "\"version\":2"), read));
  EXPECT_TRUE(read.model.parts[0].isPlain());
}

TEST(ModelVersions, BadBendsAreRefused) {
  for (const auto& [bad, word] : {std::pair{"\"bend\":[40.0,0.5]", "meets itself"},
                                  {"\"bend\":[10.0]", "2 numbers"},
                                  {"\"bend\":[10.0,\"x\"]", "2 numbers"},
                                  {"\"bend\":[10.0,0.5],\"wall\":0.004", "wall"},
                                  {"\"bend\":[10.0,0.5],\"rim\":0.5", "rim"}})
    expectRefusal(banana(), "\"bend\":[10.0,0.5]", bad, word);
}

TEST(ModelVersions, BadRimsAndWallsAreRefused) {
  for (const auto& [good, bad, word] :
       {std::array<const char*, 3>{"\"rim\":0.1", "\"rim\":1.5", "rim"},
        {"\"rim\":0.1", "\"rim\":\"high\"", "rim"},
        {"\"rim\":0.1", "\"rim\":[0.1]", "rim"},
        {"\"wall\":0.004", "\"wall\":0.09", "wall"},
        {"\"wall\":0.004", "\"wall\":-1", "wall"},
        {"\"wall\":0.004", "\"wall\":null", "wall"},
        {"\"wall\":0.004", "\"wall\":0.004,\"bend\":[1,0]", "bent"}})
    expectRefusal(bowl(), good, bad, word);
}

TEST(ModelVersions, TablesThatAreNoPlaneAreRefused) {
  for (const char* bad : {"\"table\":[0,0,0,1]",
                          "\"table\":[0,0,2,1]",
                          "\"table\":[0,0,1]",
                          "\"table\":\"flat\"",
                          "\"table\":[0,0,1,null]"})
    expectRefusal(canOnTable(), "\"table\":[0.0,0.0,1.0,-0.75]", bad, "table");
}
