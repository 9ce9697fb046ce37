// SPDX-License-Identifier: BSD-3-Clause
// What the user is told besides the result: notes, sizes, failures in plain words.
#include "bottle_view.h"
#include "program.h"
#include "text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

std::string xyzOf(const Eigen::Matrix3Xd& points) {
  std::ostringstream text;
  text << points.transpose() << "\n";
  return text.str();
}

/** \brief A square post of 40 x 40 x 100 mm all round, its sides at 45 degrees to the
 * axes. */
std::string postXyz() {
  Eigen::Matrix3Xd points(3, 4 * 21 * 41 + 2 * 19 * 19);
  Eigen::Index n = 0;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(M_PI / 4.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int side = 0; side < 4; ++side) {
    const Eigen::Matrix3d r =
        Eigen::AngleAxisd(side * M_PI / 2.0, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    for (int i = 0; i <= 20; ++i)
      for (int k = 0; k <= 40; ++k)
        points.col(n++) =
            turn * r * Eigen::Vector3d(0.02, -0.02 + 0.002 * i, 0.0025 * k);
  }
  for (const double z : {0.0, 0.1})
    for (int i = 1; i < 20; ++i)
      for (int k = 1; k < 20; ++k)
        points.col(n++) =
            turn * Eigen::Vector3d(-0.02 + 0.002 * i, -0.02 + 0.002 * k, z);
  return xyzOf(points);
}

} // namespace

TEST(Messages, NotesAreToldOnceAndStandInTheModelFile) {
  const Folder folder;
  const std::string cloud =
      folder.write("bottle.xyz", xyzOf(visiblePoints(bottle(), 2000, 0.0005)));
  const ProgramRun run = runProgram("pcl_sq_fit", {cloud, "-o", folder / "m.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto notes = nlohmann::json::parse(slurp(folder / "m.json"))["report"]["notes"];
  ASSERT_FALSE(notes.empty()) << "the camera's place was guessed";
  for (const auto& sentence : notes)
    EXPECT_EQ(count(run.err, "pcl_sq_fit: note: " + sentence.get<std::string>()), 1)
        << run.err;
  EXPECT_EQ(run.out.find("note:"), std::string::npos);
  const ProgramRun quiet = runProgram("pcl_sq_fit", {cloud, "-q"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
}

TEST(Messages, NotesOfSeveralCloudsNameTheFirstThatHasThem) {
  const Folder folder;
  const std::string text = xyzOf(visiblePoints(bottle(), 2000, 0.0005));
  const std::string first = folder.write("a.xyz", text);
  const std::string second = folder.write("b.xyz", text);
  const ProgramRun run =
      runProgram("pcl_sq_fit", {first, second, "--jsonl", "--threads", "1"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto notes =
      nlohmann::json::parse(run.out.substr(0, run.out.find('\n')))["report"]["notes"];
  ASSERT_FALSE(notes.empty()) << "the camera's place was guessed";
  for (const auto& sentence : notes) {
    EXPECT_EQ(count(run.err, "note: " + first + ": " + sentence.get<std::string>()), 1)
        << run.err;
    EXPECT_EQ(count(run.err, sentence.get<std::string>()), 1) << run.err;
  }
}

TEST(Messages, ErrorsAreToldEvenWhenQuiet) {
  const ProgramRun run = runProgram("pcl_sq_fit", {"absent.pcd", "-q"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 1) << run.err;
}

TEST(Messages, PartsThatCouldNotBeCutAreANote) {
  const Folder folder;
  const std::string cloud =
      folder.write("bottle.xyz", xyzOf(visiblePoints(bottle(), 300, 0.0005)));
  const ProgramRun run =
      runProgram("pcl_sq_fit", {cloud, "--parts", "16", "-o", folder / "m.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("16 parts were asked for"), std::string::npos) << run.err;
}

TEST(Messages, TheSizeIsThatOfTheThing) {
  const Folder folder;
  const std::string cloud = folder.write("post.xyz", postXyz());
  const ProgramRun run = runProgram(
      "pcl_sq_fit", {cloud, "--decomposition", "none", "-o", folder / "m.json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto size = nlohmann::json::parse(slurp(folder / "m.json"))["size"];
  ASSERT_EQ(size.size(), 3u);
  EXPECT_NEAR(size[0], 0.100, 0.005);
  EXPECT_NEAR(size[1], 0.040, 0.003);
  EXPECT_NEAR(size[2], 0.040, 0.003);
  EXPECT_NE(run.out.find("\n  size "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("sides [mm]"), std::string::npos) << run.out;
}

TEST(Messages, ControlCharactersOfNamesDoNotReachTheTerminal) {
  const ProgramRun run = runProgram("pcl_sq_fit", {"ab\x1b[31msent\x07.pcd"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find('\x07'), std::string::npos) << run.err;
}

TEST(Messages, TwoInputsAreNotBothStandardInput) {
  expectRefusal("pcl_sq_evaluate", {"-", "--cloud", "-"}, 2, "standard input");
}

TEST(Messages, PathsThatCannotBeOpenedAreToldInWords) {
  const Folder folder;
  const std::string cloud = folder.write("a.xyz", "0 0 0\n");
  expectRefusal("pcl_sq_fit", {cloud + "/b.xyz"}, 1, "no folder");
  expectRefusal("pcl_sq_fit", {folder / std::string(300, 'a')}, 1, "too long");
  ASSERT_EQ(symlink("loop.xyz", (folder / "loop.xyz").c_str()), 0);
  expectRefusal("pcl_sq_fit", {folder / "loop.xyz"}, 1, "circle");
}

TEST(Messages, ThereIsNoProgressWhereThereIsNoTerminal) {
  const Folder folder;
  const std::string cloud =
      folder.write("bottle.xyz", xyzOf(visiblePoints(bottle(), 500, 0.0005)));
  const ProgramRun run = runProgram("pcl_sq_fit", {cloud});
  EXPECT_EQ(run.err.find('\r'), std::string::npos);
  EXPECT_EQ(run.err.find("..."), std::string::npos) << run.err;
}

TEST(Messages, JsonThatIsNoneIsNotQuotedFromAParser) {
  const Folder folder;
  const std::string model = folder.write("m.json", "{\"schema\": \x01}");
  for (const char* program : {"pcl_sq_grasp", "pcl_sq_evaluate"}) {
    const ProgramRun run =
        runProgram(program,
                   std::string(program) == "pcl_sq_grasp"
                       ? std::vector<std::string>{model}
                       : std::vector<std::string>{model, "--truth", model});
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.sentences(), 1) << run.err;
    EXPECT_EQ(run.err.find("json.exception"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("not valid JSON"), std::string::npos) << run.err;
  }
}
