// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_stereo --sequence: frames in, JSON lines out.
#include "program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

#ifdef PCL_SQ_TEST_STEREO
using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Two frames that are alike. */
class SequenceApp : public ::testing::Test {
protected:
  void SetUp() override {
    const ProgramRun run = runProgram(
        "pcl_sq_render", {"can", "--rig", "vga", "--out", folder_ / "can", "-q"});
    ASSERT_EQ(run.code, 0) << run.err;
    for (const char* side : {"left", "right"})
      for (const char* number : {"_9.png", "_10.png"})
        copy(side, side + std::string(number));
  }
  void copy(const std::string& from, const std::string& to) const {
    std::filesystem::copy_file(folder_ / ("can/" + from + ".png"),
                               folder_ / to,
                               std::filesystem::copy_options::overwrite_existing);
  }
  ProgramRun sequence(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--sequence",
                                          folder_ / "left_*.png",
                                          folder_ / "right_*.png",
                                          "--calib",
                                          folder_ / "can/calib.yml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram("pcl_sq_stereo", arguments);
  }
  static std::vector<nlohmann::json> linesOf(const std::string& text) {
    std::vector<nlohmann::json> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

  Folder folder_;
};

} // namespace

TEST_F(SequenceApp, WritesALinePerFrameInTheOrderOfTheirNumbers) {
  const ProgramRun run = sequence();
  EXPECT_EQ(run.code, 0) << run.err;
  const auto lines = linesOf(run.out);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["input"]["path"], folder_ / "left_9.png");
  EXPECT_EQ(lines[1]["input"]["path"], folder_ / "left_10.png");
  // the second one was looked at around the first one's outline, in the same camera
  EXPECT_LT(lines[1]["input"]["points"], lines[0]["input"]["points"]);
  EXPECT_EQ(lines[1]["stereo"]["camera"], lines[0]["stereo"]["camera"]);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(lines[1]["superquadrics"][0]["translation"][axis].get<double>(),
                lines[0]["superquadrics"][0]["translation"][axis].get<double>(),
                0.005);
}

TEST_F(SequenceApp, GivesAFrameThatFailsALineWithItsError) {
  copy("mask", "left_11.png");
  copy("mask", "right_11.png");
  const ProgramRun larger = runProgram(
      "pcl_sq_render", {"can", "--out", folder_ / "larger", "-q"}); // 1024 x 768
  ASSERT_EQ(larger.code, 0) << larger.err;
  copy("../larger/left", "left_13.png");
  copy("../larger/right", "right_13.png");
  copy("left", "left_12.png");
  copy("right", "right_12.png");
  const ProgramRun run = sequence({"-o", folder_ / "models.jsonl"});
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 2) << run.err;
  const auto lines = linesOf(slurp(folder_ / "models.jsonl"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_TRUE(lines[2].contains("error"));
  EXPECT_FALSE(lines[3].contains("error"));
  EXPECT_NE(lines[4]["error"].get<std::string>().find("1024 x 768"), std::string::npos);
}

TEST_F(SequenceApp, RefusesWhatNamesNoFrames) {
  const auto refused = [](const ProgramRun& run, int code, const std::string& why) {
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_EQ(run.sentences(), 1) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
  };
  refused(sequence({"--panel", folder_ / "panel.png"}), 2, "-o alone");
  std::filesystem::remove(folder_ / "right_9.png");
  refused(sequence(), 1, "2 files but");
  std::filesystem::remove(folder_ / "right_10.png");
  refused(sequence(), 1, "no file is named like");
}
#endif
