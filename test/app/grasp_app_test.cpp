// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A model file with one can of that radius, standing on z = 0. */
std::string canJson(double radius, bool empty = false) {
  ModelFile file;
  if (!empty) {
    Superquadric can;
    can.semi_axes = {radius, radius, 0.06};
    can.epsilon1 = 0.2;
    can.center.z() = 0.06;
    file.model.parts = {can};
  }
  return toJson(file);
}

void expectRefusal(const std::vector<std::string>& arguments,
                   int code,
                   const std::string& word) {
  const ProgramRun run = runProgram("pcl_sq_grasp", arguments);
  EXPECT_EQ(run.code, code) << run.err;
  EXPECT_EQ(run.sentences(), 1) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
}

} // namespace

TEST(GraspApp, WritesRankedGraspsAndATable) {
  const Folder folder;
  const std::string model = folder.write("can.json", canJson(0.03));
  const ProgramRun run = runProgram(
      "pcl_sq_grasp",
      {model, "--table", "0,0,2,0", "--count", "5", "-o", folder / "grasps.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto json = nlohmann::json::parse(slurp(folder / "grasps.json"));
  EXPECT_EQ(json["schema"], "pcl_sq/grasps");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["table"], nlohmann::json({0.0, 0.0, 1.0, 0.0})); // normalised
  ASSERT_EQ(json["grasps"].size(), 5u);
  double last = 1.0;
  for (const auto& grasp : json["grasps"]) {
    EXPECT_NEAR(grasp["width"].get<double>(), 0.06, 0.001);
    EXPECT_GE(grasp["open_width"].get<double>(), grasp["width"].get<double>());
    EXPECT_GT(grasp["epsilon"].get<double>(), 0.0);
    EXPECT_EQ(grasp["contacts"].size(), 2u);
    EXPECT_LE(grasp["scores"]["total"].get<double>(), last);
    last = grasp["scores"]["total"].get<double>();
  }
  EXPECT_NE(run.out.find("franka_hand"), std::string::npos);
  EXPECT_NE(run.out.find("rank"), std::string::npos);
}

TEST(GraspApp, AGripperSmallerThanTheObjectFailsWithTheNearestMiss) {
  const Folder folder;
  const std::string model = folder.write("can.json", canJson(0.07));
  expectRefusal({model, "-o", folder / "grasps.json"}, 1, "nearest miss");
  EXPECT_EQ(folder.files(), 1u); // nothing was written
}

TEST(GraspApp, BadInputIsOneSentenceAndTheRightCode) {
  const Folder folder;
  const std::string model = folder.write("can.json", canJson(0.03));
  expectRefusal({folder.write("empty.json", canJson(0.03, true))}, 1, "part");
  expectRefusal({folder.write("text.json", "hello")}, 1, "text.json");
  expectRefusal({folder / "absent.json"}, 1, "absent.json");
  expectRefusal({model, "--friction", "-0.5"}, 2, "friction");
  expectRefusal({model, "--friction", "nan"}, 2, "friction");
  expectRefusal({model, "--count", "0"}, 2, "count");
  expectRefusal({model, "--gripper", "tentacle"}, 2, "franka_hand");
  expectRefusal({model, "--table", "0,0,0,1"}, 2, "--table");
  expectRefusal(
      {model, "--gripper", folder.write("a.toml", "wings = 2\n")}, 2, "wings");
  expectRefusal(
      {model, "--gripper", folder.write("b.toml", "max_opening = -1\n")}, 2, "size");
}

TEST(GraspApp, ATomlFileDescribesAGripper) {
  const Folder folder;
  const std::string model = folder.write("can.json", canJson(0.05));
  const std::string hand = folder.write(
      "hand.toml",
      "name = \"wide\"\nmax_opening = 0.2\nfinger_length = 0.12\npad_length = 0.03\n"
      "palm_width = 0.3\n");
  const ProgramRun run = runProgram("pcl_sq_grasp", {model, "--gripper", hand});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("wide"), std::string::npos) << run.out;
}

TEST(GraspApp, GraspitFilesReferToEachOther) {
  const Folder folder;
  const std::string model = folder.write("can.json", canJson(0.03));
  const ProgramRun run = runProgram(
      "pcl_sq_grasp", {model, "--table", "0,0,1,0", "--graspit", folder / "graspit"});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string world = slurp(folder / "graspit/worlds/object.xml");
  for (const std::string file :
       {"models/objects/object.xml", "models/obstacles/object_table.xml"}) {
    EXPECT_NE(world.find("<filename>" + file + "</filename>"), std::string::npos);
    EXPECT_FALSE(slurp(folder / ("graspit/" + file)).empty()) << file;
  }
  EXPECT_FALSE(slurp(folder / "graspit/models/objects/object.off").empty());
}
