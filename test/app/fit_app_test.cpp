// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_fit from the command line to the model file, and what it refuses.
#include "fit_program.h"
#include "program.h"

#include "pcl_sq/model_io.h"
#include "pcl_sq/superquadric.h"

#include <gtest/gtest.h>

#include <algorithm>

// sanitizers map more memory than any limit allows
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define SANITIZED
#endif
#endif

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(FitApp, WritesAModelThatReadsBackWithItsTimes) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  const ProgramRun run = runProgram("pcl_sq_fit", {cloud, "-o", folder / "model.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.sentences(), 0) << run.err;
  EXPECT_NE(run.out.find("superquadrics"), std::string::npos);
  ModelFile file;
  std::string why;
  ASSERT_TRUE(fromJson(slurp(folder / "model.json"), file, &why)) << why;
  EXPECT_EQ(file.model.size(), 2u);
  EXPECT_EQ(file.input_path, cloud);
  EXPECT_GT(file.distortion, 0.0);
  std::vector<std::string> stages;
  for (const auto& [stage, ms] : file.timings_ms)
    stages.push_back(stage);
  for (const char* stage : {"load", "fit", "total"})
    EXPECT_NE(std::find(stages.begin(), stages.end(), stage), stages.end()) << stage;
}

TEST(FitApp, SameModelForAnyNumberOfThreadsAndFileFormat) {
  const Folder folder;
  const std::string pcd = folder.write("bottle.pcd", bottlePcd());
  const std::string body = bottlePcd().substr(bottlePcd().find("ascii\n") + 6);
  const std::string xyz = folder.write("bottle.xyz", body);
  const auto model = [&](const std::string& cloud, const std::string& threads) {
    const ProgramRun run = runProgram(
        "pcl_sq_fit", {cloud, "--threads", threads, "-q", "-o", folder / "m.json"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(run.out.empty());
    ModelFile file, bare;
    EXPECT_TRUE(fromJson(slurp(folder / "m.json"), file));
    bare.model = file.model;
    return toJson(bare);
  };
  const std::string one = model(pcd, "1");
  EXPECT_EQ(model(pcd, "2"), one);
  EXPECT_EQ(model(xyz, "0"), one);
}

TEST(FitApp, ConfigFileGivesDefaultsAndTheCommandLineWins) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  const std::string config =
      folder.write("fit.toml", "decomposition = \"none\"\nthreads = 1\n");
  const auto parts = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {cloud, "--config", config, "-o", folder / "m.json"});
    EXPECT_EQ(runProgram("pcl_sq_fit", more).code, 0);
    ModelFile file;
    EXPECT_TRUE(fromJson(slurp(folder / "m.json"), file));
    return file.model.size();
  };
  EXPECT_EQ(parts({}), 1u);
  EXPECT_EQ(parts({"--decomposition", "prisms"}), 2u);
  expectRefusal(
      folder, {cloud, "--config", folder.write("bad.toml", "colour = 3\n")}, 2);
}

TEST(FitApp, TapersACupAndLeavesACanAlone) {
  const Folder folder;
  Superquadric cup;
  cup.center = {0.0, 0.1, 0.7};
  cup.semi_axes = {0.036, 0.036, 0.048};
  cup.epsilon1 = 0.15;
  for (const double taper : {0.25, 0.0}) {
    cup.kx = cup.ky = taper;
    std::vector<Eigen::Vector3f> points;
    for (const Eigen::Vector3d& p : sampleUniform(cup, 1500))
      points.push_back(p.cast<float>());
    const std::string cloud = folder.write("cup.pcd", pcdOf(points));
    const ProgramRun run = runProgram("pcl_sq_fit",
                                      {cloud,
                                       "--decomposition",
                                       "none",
                                       "--taper",
                                       "-o",
                                       folder / "m.json",
                                       "--mesh",
                                       folder / "m.obj"});
    ASSERT_EQ(run.code, 0) << run.err;
    ModelFile file;
    std::string why;
    ASSERT_TRUE(fromJson(slurp(folder / "m.json"), file, &why)) << why;
    ASSERT_EQ(file.model.size(), 1u);
    const Superquadric& found = file.model.parts[0];
    EXPECT_EQ(found.isTapered(), taper > 0.0);
    EXPECT_NEAR(std::abs(found.kx), taper, 0.01);
    EXPECT_NEAR(found.volume(), cup.volume(), 0.01 * cup.volume());
    std::istringstream mesh(slurp(folder / "m.obj"));
    std::string word;
    for (std::string line; std::getline(mesh, line);) {
      std::istringstream fields(line);
      Eigen::Vector3d v;
      if (fields >> word && word == "v" && fields >> v.x() >> v.y() >> v.z()) {
        ASSERT_NEAR(found.gauge(v), 1.0, 1e-3);
      }
    }
    const ProgramRun grasps = runProgram("pcl_sq_grasp", {folder / "m.json"});
    EXPECT_EQ(grasps.code, 0) << grasps.err;
  }
  expectRefusal(
      folder, {folder / "cup.pcd", "--taper", "--decomposition", "prisms"}, 2);
}

TEST(FitApp, PartsMayBeTaperedAndEvaluateReadsThem) {
  const Folder folder;
  Superquadric pot;
  pot.center = {0.0, 0.1, 0.7};
  pot.semi_axes = {0.036, 0.036, 0.048};
  pot.epsilon1 = 0.15;
  pot.kx = pot.ky = 0.35;
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& p : sampleUniform(pot, 2000))
    points.push_back(p.cast<float>());
  const std::string cloud = folder.write("pot.pcd", pcdOf(points));
  const ProgramRun run = runProgram("pcl_sq_fit", {cloud, "-o", folder / "m.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  ModelFile file;
  std::string why;
  ASSERT_TRUE(fromJson(slurp(folder / "m.json"), file, &why)) << why;
  ASSERT_EQ(file.model.size(), 1u);
  EXPECT_TRUE(file.model.parts[0].isTapered());
  EXPECT_NEAR(file.model.parts[0].volume(), pot.volume(), 0.02 * pot.volume());
  EXPECT_LT(file.rms_distance, 5e-4);
  const ProgramRun judged = runProgram(
      "pcl_sq_evaluate", {folder / "m.json", "--cloud", cloud, "--format", "table"});
  ASSERT_EQ(judged.code, 0) << judged.err;
  std::istringstream table(judged.out.substr(judged.out.find("cloud to model, rms")));
  std::string word;
  double rms = 1e9;
  table >> word >> word >> word >> word >> rms;
  EXPECT_LT(rms, 0.5) << judged.out; // [mm]
}

TEST(FitApp, BadCommandLinesEndWithTwo) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  expectRefusal(folder, {}, 2);
  expectRefusal(folder, {cloud, "--no-such-option"}, 2);
  expectRefusal(folder, {cloud, "--decomposition", "cubes"}, 2);
  expectRefusal(folder, {cloud, "--roi", "1,2,3"}, 2);
  expectRefusal(folder, {cloud, "--roi", "1,2,0,5"}, 2);
  expectRefusal(folder, {cloud, "--box", "1,1,1,0,0,0"}, 2);
  expectRefusal(folder, {cloud, "--box", "a,b,c,d,e,f"}, 2);
  expectRefusal(folder, {cloud, "--grasp-threshold", "-1"}, 2);
  expectRefusal(folder, {cloud, "--threads", "-3"}, 2);
  expectRefusal(folder, {cloud, "--voxel-percent", "0,5,5"}, 2);
  EXPECT_EQ(runProgram("pcl_sq_fit", {"--help"}).code, 0);
  EXPECT_NE(runProgram("pcl_sq_fit", {"--help"}).out.find("Examples"),
            std::string::npos);
  EXPECT_NE(runProgram("pcl_sq_fit", {"--version"}).out.find("0."), std::string::npos);
}

TEST(FitApp, RegionsThatMissAndGridsThatAreTooFineAreRefused) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  expectRefusal(folder, {cloud, "--box", "5,5,5,6,6,6"});
  expectRefusal(folder, {cloud, "--roi", "1,2,3,4"}); // not organized
  expectRefusal(folder, {cloud, "--divisions", "10000,10000,10000"}, 2);
}

TEST(FitApp, OutputsThatCannotBeWrittenAreRefusedBeforeTheWork) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  const std::string nowhere = folder / "missing/model.json";
  const ProgramRun run = runProgram("pcl_sq_fit", {cloud, "-o", nowhere});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 1) << run.err;
  EXPECT_EQ(folder.files(), 1u);
}

#ifndef SANITIZED

TEST(FitApp, TooLittleMemoryIsAnErrorAndNotAKill) {
  const Folder folder;
  const std::string cloud = folder.write("bottle.pcd", bottlePcd());
  const ProgramRun run =
      runProgram("pcl_sq_fit",
                 {cloud, "--threads", "1", "--divisions", "250,250,250"},
                 "ulimit -v 600000;");
  EXPECT_TRUE(run.code == 0 || run.code == 1) << run.code << run.err;
  std::string big = "0 0 0\n";
  while (big.size() < (48u << 20))
    big += big;
  const ProgramRun full =
      runProgram("pcl_sq_fit", {folder.write("big.xyz", big)}, "ulimit -v 500000;");
  EXPECT_EQ(full.code, 1) << full.err;
  EXPECT_EQ(full.sentences(), 1) << full.err;
}
#endif
