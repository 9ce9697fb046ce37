// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_grasp and pcl_sq_evaluate on the things of a scene file.
#include "program.h"

#include "pcl_sq/scene_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

constexpr double RADIUS = 0.03;

SceneFileObject canAt(double x, double radius = RADIUS) {
  Superquadric can;
  can.semi_axes = {radius, radius, 0.06};
  can.epsilon1 = 0.2;
  can.center = {x, 0.0, 0.06};
  SceneFileObject object;
  object.file.model.parts = {can};
  return object;
}

/** \brief Cans on the table z = 0, from left to right. */
std::string writeScene(const Folder& folder, const std::vector<double>& places) {
  SceneFile scene;
  for (const double x : places)
    scene.objects.push_back(canAt(x));
  scene.table = {0.0, 0.0, 1.0, 0.0};
  return folder.write("scene.json", toJson(scene));
}

nlohmann::json graspsOf(const Folder& folder,
                        const std::string& scene,
                        const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {scene, "-o", folder / "grasps.json", "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProgramRun run = runProgram("pcl_sq_grasp", arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return nlohmann::json::parse(slurp(folder / "grasps.json"));
}

/** \brief Largest distance along x of a contact from a place. */
double farthestContact(const nlohmann::json& grasps, double x) {
  double farthest = 0.0;
  for (const auto& grasp : grasps["grasps"])
    for (const auto& contact : grasp["contacts"])
      farthest = std::max(farthest, std::abs(contact["position"][0].get<double>() - x));
  return farthest;
}

nlohmann::json judged(const std::vector<std::string>& arguments) {
  const ProgramRun run = runProgram("pcl_sq_evaluate", arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

} // namespace

TEST(SceneFiles, AGraspIsOfTheThingThatIsAskedFor) {
  const Folder folder;
  const std::string scene = writeScene(folder, {-0.2, 0.0, 0.2});
  for (int k = 0; k < 3; ++k) {
    const nlohmann::json grasps =
        graspsOf(folder, scene, {"--object", std::to_string(k + 1)});
    EXPECT_FALSE(grasps["grasps"].empty());
    EXPECT_LT(farthestContact(grasps, -0.2 + 0.2 * k), RADIUS + 1e-3);
    EXPECT_EQ(grasps["table"], nlohmann::json({0.0, 0.0, 1.0, 0.0}));
  }
}

TEST(SceneFiles, OtherThingsAreInTheWayOfTheHand) {
  const Folder folder;
  const auto sideways = [](const nlohmann::json& grasps) {
    int count = 0; // whose fingers come from left and right
    for (const auto& grasp : grasps["grasps"]) {
      const auto& c = grasp["contacts"];
      count += std::abs(c[0]["position"][0].get<double>() -
                        c[1]["position"][0].get<double>()) > 1.8 * RADIUS;
    }
    return count;
  };
  const std::vector<std::string> many = {"--object", "2", "--count", "200"};
  const nlohmann::json free =
      graspsOf(folder, writeScene(folder, {-0.5, 0.0, 0.5}), many);
  EXPECT_GT(sideways(free), 0);
  // three millimetres leave no room for a finger on either side
  const double beside = 2.0 * RADIUS + 0.003;
  const nlohmann::json hemmed =
      graspsOf(folder, writeScene(folder, {-beside, 0.0, beside}), many);
  EXPECT_FALSE(hemmed["grasps"].empty());
  EXPECT_EQ(sideways(hemmed), 0);
}

TEST(SceneFiles, WithoutANumberTheThingWithTheBestGraspIsTaken) {
  const Folder folder;
  SceneFile scene;
  // only one of them is narrower than the hand opens
  scene.objects = {canAt(-0.3, 0.07), canAt(0.0), canAt(0.3, 0.07)};
  scene.table = {0.0, 0.0, 1.0, 0.0};
  const nlohmann::json grasps =
      graspsOf(folder, folder.write("scene.json", toJson(scene)), {});
  EXPECT_FALSE(grasps["grasps"].empty());
  EXPECT_LT(farthestContact(grasps, 0.0), RADIUS + 1e-3);
}

TEST(SceneFiles, AThingIsJudgedByItselfAndAllByACloud) {
  const Folder folder;
  const std::string scene = writeScene(folder, {-0.2, 0.2});
  // points of both cans' sides at half their height
  std::string cloud;
  for (const double x : {-0.2, 0.2})
    for (int i = 0; i < 60; ++i) {
      const double angle = 2.0 * M_PI * i / 60;
      for (const double z : {0.04, 0.06, 0.08})
        cloud += std::to_string(x + RADIUS * std::cos(angle)) + " " +
                 std::to_string(RADIUS * std::sin(angle)) + " " + std::to_string(z) +
                 "\n";
    }
  const std::string points = folder.write("points.xyz", cloud);
  const auto rms = [](const nlohmann::json& json) {
    return json["cloud"]["distance"]["rms"].get<double>();
  };
  const nlohmann::json all = judged({scene, "--cloud", points});
  EXPECT_LT(rms(all), 1e-3) << all.dump(2);
  const nlohmann::json one = judged({scene, "--object", "2", "--cloud", points});
  EXPECT_GT(rms(one), 0.1) << one.dump(2);
}

TEST(SceneFiles, APictureAndAPageShowTheThingsThatAreAskedFor) {
  const Folder folder;
  const std::string scene = writeScene(folder, {-0.2, 0.2});
  const auto written = [&](const std::vector<std::string>& options) {
    const std::string picture = folder / "out.png", page = folder / "out.html";
    std::vector<std::string> arguments = {
        scene, "--size", "200x150", "-o", picture, "--html", page};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram("pcl_sq_snapshot", arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return std::make_pair(slurp(picture), slurp(page));
  };
  const auto all = written({}), one = written({"--object", "1"});
  EXPECT_GT(all.first.size(), 1000u);
  EXPECT_NE(all.first, one.first);
  EXPECT_NE(all.second, one.second);
  expectRefusal("pcl_sq_snapshot",
                {scene, "--export", folder / "both.urdf"},
                2,
                ".scene"); // a robot's object is one
  const ProgramRun urdf = runProgram(
      "pcl_sq_snapshot", {scene, "--object", "1", "--export", folder / "one.urdf"});
  EXPECT_EQ(urdf.code, 0) << urdf.err;
}

TEST(SceneFiles, NumbersThatAreNoThingAreRefusedInASentence) {
  const Folder folder;
  const std::string scene = writeScene(folder, {-0.2, 0.2});
  const std::string model = folder.write("can.json", toJson(canAt(0.0).file));
  const std::string cloud = folder.write("points.xyz", "0 0 0\n1 0 0\n0 1 0\n");
  expectRefusal("pcl_sq_grasp", {scene, "--object", "3"}, 2, "2 only");
  expectRefusal("pcl_sq_grasp", {model, "--object", "1"}, 2, "no effect");
  expectRefusal(
      "pcl_sq_evaluate", {scene, "--cloud", cloud, "--object", "3"}, 2, "2 only");
  expectRefusal(
      "pcl_sq_evaluate", {model, "--cloud", cloud, "--object", "1"}, 2, "no effect");
}
