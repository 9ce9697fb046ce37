// SPDX-License-Identifier: BSD-3-Clause
// Rendering, the chain from two images, evaluation and calibration, as programs.
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A scene that all tests share. */
class StereoApp : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = new Folder();
    const ProgramRun run = runProgram(
        "pcl_sq_render", {"can", "--rig", "vga", "--out", *folder_ / "can", "-q"});
    ASSERT_EQ(run.code, 0) << run.err;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string file(const std::string& name) {
    return *folder_ / ("can/" + name);
  }
  static std::vector<std::string> pair() {
    return {file("left.png"), file("right.png"), "--calib", file("calib.yml")};
  }
  static ProgramRun stereo(std::vector<std::string> arguments,
                           const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram("pcl_sq_stereo", arguments);
  }
  static void expectRefusal(const std::vector<std::string>& arguments,
                            const std::string& reason,
                            int code = 1) {
    test::expectRefusal("pcl_sq_stereo", arguments, code, reason);
  }

  static Folder* folder_;
};
Folder* StereoApp::folder_ = nullptr;

} // namespace

TEST_F(StereoApp, MakesAModelAPanelAndAllFilesFromAPair) {
  const Folder out;
  const ProgramRun run = stereo(pair(),
                                {"--matcher",
                                 "sgbm",
                                 "--preset",
                                 "paper",
                                 "--click",
                                 "320,240",
                                 "-o",
                                 out / "m.json",
                                 "--panel",
                                 out / "p.png",
                                 "--cloud",
                                 out / "c.pcd",
                                 "--disparity",
                                 out / "d.png",
                                 "--histogram",
                                 out / "h.png"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(out.files(), 5u);
  ModelFile file;
  std::string why;
  ASSERT_TRUE(fromJson(slurp(out / "m.json"), file, &why)) << why;
  EXPECT_FALSE(file.model.empty());
  const std::string figures = out / "figures.json";
  const ProgramRun judged = runProgram(
      "pcl_sq_evaluate",
      {out / "m.json", "--truth", StereoApp::file("truth.json"), "-o", figures});
  ASSERT_EQ(judged.code, 0) << judged.err;
  EXPECT_NE(slurp(figures).find("\"iou\""), std::string::npos);
  EXPECT_EQ(judged.out, slurp(figures));
}

TEST_F(StereoApp, FindsTheObjectWithoutAHint) {
  const Folder out;
  const ProgramRun run = stereo(pair(), {"--preset", "paper", "-o", out / "m.json"});
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(StereoApp, RefusesBadInputWithOneSentence) {
  const std::string l = file("left.png"), r = file("right.png"), c = file("calib.yml");
  expectRefusal({l, r}, "--calib is missing", 2);
  expectRefusal({l, "--calib", c}, "right image", 2);
  expectRefusal({"no.png", r, "--calib", c}, "does not exist");
  expectRefusal({l, r, "--calib", "no.yml"}, "cannot read 'no.yml'");
  expectRefusal({r, l, "--calib", c}, "exchange left and right");
  expectRefusal({l, r, "--calib", c, "--roi", "900,900,50,50"}, "outside");
  expectRefusal({l, r, "--calib", c, "--roi", "10,10,0,50"}, "above 0", 2);
  expectRefusal({l, r, "--calib", c, "--matcher", "magic"}, "magic", 2);
  expectRefusal({l, r, "--calib", c, "--block-size", "4"}, "odd", 2);
  expectRefusal({l, r, "--calib", c, "--clik", "3,4"}, "--clik", 2);
  expectRefusal({l, r, "--calib", c, "--segment", "none"}, "needs --roi", 2);
  expectRefusal({l, r, "--calib", c, "--click", "5000,10"}, "within it");
  expectRefusal({l, r, "--calib", c, "--color", "300,0,0"}, "from 0 to 255", 2);
  expectRefusal({l, r, "--calib", c, "--color", "255,0,255"}, "give another one");
  expectRefusal({l, file("mask.png"), "--calib", c},
                "nothing was found that stands on a table");
  const Folder folder;
  const std::string grey =
      folder.write("grey.pgm", "P5\n640 480\n255\n" + std::string(640 * 480, '\x80'));
  expectRefusal({grey, grey, "--calib", c}, "no texture");
  const std::string small =
      folder.write("small.pgm", "P5\n64 48\n255\n" + std::string(64 * 48, '\x80'));
  expectRefusal({l, small, "--calib", c}, "two images of one size");
  const std::string zero =
      folder.write("zero.txt", "f=811.6\ncx=319.5\ncy=239.5\nbaseline=0\n");
  expectRefusal({l, r, "--calib", zero}, "baseline is zero");
  const std::string other = folder.write(
      "other.txt",
      "f=811.6\ncx=319.5\ncy=239.5\nbaseline=0.1\nwidth=320\nheight=200\n");
  expectRefusal({l, r, "--calib", other}, "calibration is for");
}

TEST_F(StereoApp, MasksThatDoNotSuitAreRefusedAndNothingIsWritten) {
  const Folder folder, out;
  // a 1 x 1 portable grey map is the smallest image there is
  const std::string tiny = folder.write("tiny.pgm", "P2\n1 1\n255\n0\n");
  auto arguments = pair();
  arguments.insert(arguments.end(), {"-o", out / "m.json", "--panel", out / "p.png"});
  arguments.insert(arguments.end(), {"--mask", tiny});
  expectRefusal(arguments, "differ in size");
  std::string image = "P5\n640 480\n255\n" + std::string(640 * 480, '\0');
  arguments.back() = folder.write("black.pgm", image);
  expectRefusal(arguments, "empty");
  for (std::size_t row = 0; row < 4; ++row) // the image's corner: nothing matches there
    for (std::size_t column = 0; column < 4; ++column)
      image[image.size() - 640 * 480 + 640 * row + column] = '\xff';
  arguments.back() = folder.write("corner.pgm", image);
  expectRefusal(arguments, "no cluster of depths");
  EXPECT_EQ(out.files(), 0u);
}

TEST_F(StereoApp, TheBorderFilterTakesTheRimOfTheObjectAway) {
  const Folder out;
  std::vector<std::size_t> sizes;
  for (const bool filter : {false, true}) {
    std::vector<std::string> more{
        "--click", "320,240", "-o", out / "m.json", "--object-cloud", out / "o.ply"};
    if (filter)
      more.emplace_back("--border-filter");
    const ProgramRun run = stereo(pair(), more);
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string cloud = slurp(out / "o.ply"), key = "element vertex ";
    sizes.push_back(std::stoul(cloud.substr(cloud.find(key) + key.size())));
  }
  EXPECT_LT(sizes[1], sizes[0]);
  EXPECT_GT(sizes[1], sizes[0] / 2);
}

TEST_F(StereoApp, DisparitiesAreRefinedUnlessThePaperOrTheUserSaysOtherwise) {
  const Folder out;
  const std::vector<std::pair<std::vector<std::string>, bool>> cases{
      {{}, true},
      {{"--no-refine"}, false},
      {{"--preset", "paper"}, false},
      {{"--preset", "paper", "--refine"}, true}};
  std::vector<std::string> disparities;
  for (const auto& [options, refined] : cases) {
    std::vector<std::string> more = options;
    more.insert(
        more.end(),
        {"--click", "320,240", "--disparity", out / "d.pfm", "-o", out / "m.json"});
    more.insert(more.end(),
                {"--matcher", "bm"}); // the paper's; the default has its own
    const ProgramRun run = stereo(pair(), more);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(slurp(out / "m.json")
                  .find(refined ? "\"refined\": true" : "\"refined\": false"),
              std::string::npos);
    disparities.push_back(slurp(out / "d.pfm"));
  }
  EXPECT_TRUE(disparities[0] != disparities[1]);
  EXPECT_TRUE(disparities[1] == disparities[2]);
  EXPECT_TRUE(disparities[0] == disparities[3]);
}

TEST_F(StereoApp, SmoothedDisparitiesAreWrittenAndNamed) {
  const Folder out;
  for (const std::string name : {"plain", "wls"}) {
    std::vector<std::string> more{"--matcher",
                                  "sgbm",
                                  "--click",
                                  "320,240",
                                  "--disparity",
                                  out / (name + ".pfm"),
                                  "-o",
                                  out / (name + ".json")};
    if (name == "wls")
      more.emplace_back("--wls");
    const ProgramRun run = stereo(pair(), more);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(slurp(out / (name + ".json"))
                  .find(name == "wls" ? "\"wls\": true" : "\"wls\": false"),
              std::string::npos);
  }
  EXPECT_NE(slurp(out / "plain.pfm"), slurp(out / "wls.pfm"));
}

TEST_F(StereoApp, AMeshWithAPoseIsJudgedAsTheTruthThatHoldsBoth) {
  const Folder out;
  ASSERT_EQ(stereo(pair(), {"--click", "320,240", "-o", out / "m.json"}).code, 0);
  const auto judge = [&](const std::vector<std::string>& reference) {
    std::vector<std::string> arguments{out / "m.json"};
    arguments.insert(arguments.end(), reference.begin(), reference.end());
    const ProgramRun run = runProgram("pcl_sq_evaluate", arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out).value("shape", nlohmann::json());
  };
  const auto truth = nlohmann::json::parse(slurp(StereoApp::file("truth.json")));
  std::string pose;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      pose += truth["pose"]["rotation"][i][k].dump() + ",";
    pose += truth["pose"]["translation"][i].dump() + ",";
  }
  pose += "0,0,0,1";
  const auto by_truth = judge({"--truth", StereoApp::file("truth.json")});
  const auto by_pose = judge({"--mesh",
                              StereoApp::file("mesh.ply"),
                              "--pose",
                              pose,
                              "--symmetry",
                              "revolution"});
  ASSERT_TRUE(by_truth.contains("iou") && by_pose.contains("iou"));
  EXPECT_NEAR(by_pose["iou"].get<double>(), by_truth["iou"].get<double>(), 1e-6);
  EXPECT_NEAR(by_pose["axis_error_deg"].get<double>(),
              by_truth["axis_error_deg"].get<double>(),
              1e-6);
  // without the pose the mesh stands in the camera
  const auto elsewhere = judge({"--mesh", StereoApp::file("mesh.ply")});
  EXPECT_LT(elsewhere["iou"].get<double>(), 0.01);
}

TEST_F(StereoApp, TheSameSeedGivesTheSameBytes) {
  const Folder out;
  for (const char* name : {"a", "b"})
    ASSERT_EQ(runProgram("pcl_sq_render",
                         {"cup",
                          "--rig",
                          "small",
                          "-o",
                          out / name,
                          "--distortion",
                          "--threads",
                          name[0] == 'a' ? "1" : "3"})
                  .code,
              0);
  for (const char* name : {"left.png",
                           "raw_right.png",
                           "calib_raw.yml",
                           "truth.json",
                           "disparity.pfm",
                           "mesh.ply"})
    EXPECT_EQ(slurp(out / ("a/" + std::string(name))),
              slurp(out / ("b/" + std::string(name))))
        << name;
}

TEST(RenderApp, RefusesBadCommandLines) {
  const Folder out;
  const std::string d = out / "x";
  EXPECT_EQ(runProgram("pcl_sq_render", {"elephant", "-o", d}).code, 2);
  EXPECT_EQ(runProgram("pcl_sq_render", {"-o", d}).code, 2);
  EXPECT_EQ(runProgram("pcl_sq_render", {"can"}).code, 2);
  EXPECT_EQ(runProgram("pcl_sq_render", {"--mesh", "no.ply", "-o", d}).code, 1);
  EXPECT_EQ(runProgram("pcl_sq_render", {"can", "--offset", "9,0", "-o", d}).code, 1);
}

TEST(EvaluateApp, RefusesBadInput) {
  const Folder out;
  const std::string model = out.write("m.json", "{}");
  EXPECT_EQ(runProgram("pcl_sq_evaluate", {model}).code, 2);
  EXPECT_EQ(runProgram("pcl_sq_evaluate", {model, "--truth", "no.json"}).code, 1);
  EXPECT_EQ(runProgram("pcl_sq_evaluate", {"no.json", "--cloud", "c.pcd"}).code, 1);
}

TEST(CalibrateApp, RefusesBadInput) {
  const Folder out;
  const std::string c = out / "c.yml";
  EXPECT_EQ(runProgram("pcl_sq_calibrate", {"a.png", "--square", "1", "-o", c}).code,
            2);
  EXPECT_EQ(
      runProgram("pcl_sq_calibrate", {"a.png", "b.png", "--square", "1", "-o", c}).code,
      1);
  EXPECT_EQ(runProgram("pcl_sq_calibrate",
                       {"a.png", "b.png", "--board", "x", "--square", "1", "-o", c})
                .code,
            2);
}
