// SPDX-License-Identifier: BSD-3-Clause
// --viewpoint, --table and --up in every program, and the table in the model file.
#include "program.h"
#include "surface_cloud.h"
#include "table_scene.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A tin on a table in a robot's frame, as a list of points. */
std::string tinPcd(bool viewpoint) {
  TableScene scene;
  scene.stand({0, 0}, {0.035, 0.035, 0.025}, 0.1, 1.0);
  Eigen::Matrix3Xf list = TableScene::listOf(scene.inRoom());
  const Eigen::Vector3d robot(0.8, 0.0, 0.75);
  list.colwise() += robot.cast<float>();
  const Eigen::Vector3d eye = scene.camera.center + robot;
  std::ostringstream text;
  text
      << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      << "WIDTH " << list.cols() << "\nHEIGHT 1\nVIEWPOINT ";
  if (viewpoint)
    text << eye.transpose();
  else
    text << "0 0 0";
  text << " 1 0 0 0\nPOINTS " << list.cols() << "\nDATA ascii\n";
  for (Eigen::Index i = 0; i < list.cols(); ++i)
    text << list.col(i).transpose() << "\n";
  return text.str();
}

nlohmann::json run(const std::string& program,
                   std::vector<std::string> arguments,
                   const std::string& output) {
  arguments.insert(arguments.end(), {"-o", output});
  const ProgramRun run = runProgram(program, arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return run.code == 0 ? nlohmann::json::parse(slurp(output)) : nlohmann::json();
}

} // namespace

TEST(FramesApp, TheTableThatWasRemovedStandsInTheModelAndGraspsKeepAboveIt) {
  const Folder folder;
  const std::string cloud = folder.write("tin.pcd", tinPcd(true));
  const auto model =
      run("pcl_sq_fit", {cloud, "--remove-plane"}, folder / "model.json");
  EXPECT_EQ(model["version"], 3);
  ASSERT_EQ(model["table"].size(), 4u);
  EXPECT_NEAR(model["table"][2].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(model["table"][3].get<double>(), -0.75, 0.003);
  const auto grasps =
      run("pcl_sq_grasp", {folder / "model.json"}, folder / "grasps.json");
  EXPECT_EQ(grasps["table"], model["table"]);
  ASSERT_FALSE(grasps["grasps"].empty());
  for (const auto& grasp : grasps["grasps"])
    for (const auto& contact : grasp["contacts"])
      EXPECT_GT(contact["position"][2].get<double>(), 0.75);
  const auto told = run("pcl_sq_grasp",
                        {folder / "model.json", "--table", "0,0,1,-0.74"},
                        folder / "told.json");
  EXPECT_EQ(told["table"], nlohmann::json({0.0, 0.0, 1.0, -0.74}));
}

TEST(FramesApp, OnlyAKnownViewpointMakesSidesUnseen) {
  // a can from all around, before the origin as if a camera were there
  Superquadric can;
  can.semi_axes = {0.03, 0.03, 0.06};
  can.epsilon1 = 0.1;
  can.center = {0.0, 0.0, 0.7};
  can.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0; // upright, y down
  std::ostringstream text;
  for (const Eigen::Vector3d& p : sampleUniform(can, 4000))
    text << p.transpose() << "\n";
  const Folder folder;
  const std::string cloud = folder.write("can.xyz", text.str());
  const auto fit = run("pcl_sq_fit", {cloud}, folder / "model.json");
  EXPECT_FALSE(fit["report"].value("sensor_known", false));
  const auto unseen = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {cloud, "--min-observed", "0.6"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto json = run("pcl_sq_grasp", arguments, folder / "grasps.json");
    return json["rejections"].value("unseen", -1);
  };
  EXPECT_EQ(unseen({}), 0);
  EXPECT_GT(unseen({"--viewpoint", "0,0,0"}), 0);
}

TEST(FramesApp, ToldFramesCountInPlaneRemoval) {
  const Folder folder;
  const std::string cloud = folder.write("tin.pcd", tinPcd(false));
  for (const std::vector<std::string>& told :
       {std::vector<std::string>{"--viewpoint", "0.8,-0.55,1.17"},
        {"--up", "z"},
        {"--up", "0,0,3"},
        {"--table", "0,0,1,-0.75"}}) {
    std::vector<std::string> arguments = {cloud, "--remove-plane"};
    arguments.insert(arguments.end(), told.begin(), told.end());
    const auto model = run("pcl_sq_fit", arguments, folder / "model.json");
    ASSERT_EQ(model["superquadrics"].size(), 1u) << told[0];
    EXPECT_NEAR(model["superquadrics"][0]["translation"][2].get<double>(), 0.775, 0.004)
        << told[0];
    EXPECT_GT(model["table"][2].get<double>(), 0.99) << told[0];
  }
  // a table far above everything: nothing stands on it
  const ProgramRun run = runProgram(
      "pcl_sq_fit",
      {cloud, "--remove-plane", "--table", "0,0,1,-3", "-o", folder / "none.json"});
  EXPECT_EQ(run.code, 1) << run.err;
}

TEST(FramesApp, NonsenseIsRefusedByEveryProgram) {
  const Folder folder;
  const std::string cloud = folder.write("tin.pcd", tinPcd(false));
  ModelFile file;
  file.model.parts.resize(1);
  const std::string model = folder.write("model.json", toJson(file));
  const std::vector<std::vector<std::string>> commands = {
      {"pcl_sq_fit", cloud}, {"pcl_sq_grasp", model}, {"pcl_sq_snapshot", model}};
  for (const std::vector<std::string>& command : commands)
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--up", "0,0,0"},
          {"--up", "w"},
          {"--table", "0,0,0,1"},
          {"--viewpoint", "nan,0,0"}}) {
      std::vector<std::string> arguments(command.begin() + 1, command.end());
      arguments.insert(arguments.end(), {"-o", folder / "out.png"});
      arguments.insert(arguments.end(), wrong.begin(), wrong.end());
      const ProgramRun run = runProgram(command[0], arguments);
      EXPECT_EQ(run.code, 2) << command[0] << ' ' << wrong[0] << ' ' << run.err;
      EXPECT_NE(run.err.find(wrong[0]), std::string::npos) << run.err;
    }
}

TEST(FramesApp, ATableAndAnUpThatContradictAreRefused) {
  for (const char* up : {"-z", "x", "0,1,0"}) {
    const ProgramRun run =
        runProgram("pcl_sq_fit",
                   {"absent.pcd", "--remove-plane", "--table", "0,0,1,0", "--up", up});
    EXPECT_EQ(run.code, 2) << up;
    EXPECT_NE(run.err.find("contradict"), std::string::npos) << run.err;
  }
  const ProgramRun agree =
      runProgram("pcl_sq_fit", {"absent.pcd", "--table", "0,0,1,0", "--up", "0,.2,1"});
  EXPECT_EQ(agree.err.find("contradict"), std::string::npos) << agree.err;
}
