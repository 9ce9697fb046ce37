// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

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
  test::expectRefusal("pcl_sq_grasp", arguments, code, word);
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
  expectRefusal(
      {folder.write("empty.json", canJson(0.03, true))}, 1, "no superquadric");
  expectRefusal({folder.write("text.json", "hello")}, 1, "text.json");
  expectRefusal({folder / "absent.json"}, 1, "absent.json");
  expectRefusal({model, "--friction", "-0.5"}, 2, "friction");
  expectRefusal({model, "--friction", "nan"}, 2, "friction");
  expectRefusal({model, "--up", "z"}, 2, "--table");
  expectRefusal({model, "--count", "0"}, 2, "count");
  expectRefusal({model, "--gripper", "tentacle"}, 2, "franka_hand");
  expectRefusal({model, "--table", "0,0,0,1"}, 2, "--table");
  expectRefusal(
      {model, "--gripper", folder.write("a.toml", "wings = 2\n")}, 2, "wings");
  expectRefusal({model, "--gripper", folder.write("b.toml", "max_opening = -1\n")},
                2,
                "max_opening");
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
  const std::string world = slurp(folder / "graspit/worlds/can.xml");
  for (const std::string file :
       {"models/objects/can.xml", "models/obstacles/can_table.xml"}) {
    EXPECT_NE(world.find("<filename>" + file + "</filename>"), std::string::npos);
    EXPECT_FALSE(slurp(folder / ("graspit/" + file)).empty()) << file;
  }
  EXPECT_FALSE(slurp(folder / "graspit/models/objects/can.off").empty());
}

TEST(GraspApp, GraspitExportsOfOtherNamesStayAndOwnFilesAreReplacedWhole) {
  const Folder folder;
  const std::string can = folder.write("can.json", canJson(0.03));
  const std::string cup = folder.write("cup.json", canJson(0.04));
  const std::string out = folder / "graspit";
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--graspit", out});
    return runProgram("pcl_sq_grasp", more);
  };
  ASSERT_EQ(run({can, "--table", "0,0,1,0", "--graspit-parts"}).code, 0);
  const std::string before = slurp(out + "/models/objects/can.off");
  const std::string list = slurp(out + "/can_files.txt");
  ASSERT_EQ(run({cup}).code, 0);
  EXPECT_EQ(slurp(out + "/models/objects/can.off"), before);
  EXPECT_EQ(slurp(out + "/can_files.txt"), list);
  EXPECT_NE(slurp(out + "/models/objects/cup.off"), before);
  // again, without table and parts: nothing of the first is left behind
  ASSERT_EQ(run({cup, "--graspit-name", "can"}).code, 0);
  EXPECT_EQ(slurp(out + "/models/objects/can.off"),
            slurp(out + "/models/objects/cup.off"));
  for (const std::string gone : {"/models/obstacles/can_table.off",
                                 "/models/obstacles/can_table.xml",
                                 "/models/objects/can_part0.xml",
                                 "/worlds/can_parts.xml"})
    EXPECT_FALSE(std::ifstream(out + gone).good()) << gone;
  EXPECT_TRUE(std::ifstream(out + "/worlds/cup.xml").good());
}

TEST(GraspApp, GraspitFilesOfOtherOriginAreNotReplaced) {
  const Folder folder;
  const std::string mug = folder.write("mug.json", canJson(0.03));
  std::filesystem::create_directories(folder / "graspit/models/objects");
  folder.write("graspit/models/objects/mug.xml", "GraspIt!'s own");
  const ProgramRun run =
      runProgram("pcl_sq_grasp", {mug, "--graspit", folder / "graspit"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("--graspit-name"), std::string::npos) << run.err;
  EXPECT_EQ(slurp(folder / "graspit/models/objects/mug.xml"), "GraspIt!'s own");
  EXPECT_FALSE(std::filesystem::exists(folder / "graspit/worlds/mug.xml"));
  EXPECT_EQ(runProgram("pcl_sq_grasp",
                       {mug, "--graspit", folder / "graspit", "--graspit-name", "a/b"})
                .code,
            2);
}
