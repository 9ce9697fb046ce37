// SPDX-License-Identifier: BSD-3-Clause
// Rendering, the chain from two images, evaluation and calibration, as programs.
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

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
    const ProgramRun run = stereo(arguments, {});
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_EQ(run.sentences(), 1) << run.err;
    EXPECT_NE(run.err.find(reason), std::string::npos) << run.err;
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
  expectRefusal({"no.png", r, "--calib", c}, "cannot read the image");
  expectRefusal({l, r, "--calib", "no.yml"}, "cannot read 'no.yml'");
  expectRefusal({r, l, "--calib", c}, "exchange left and right");
  expectRefusal({l, r, "--calib", c, "--roi", "900,900,50,50"}, "outside");
  expectRefusal({l, r, "--calib", c, "--roi", "10,10,0,50"}, "positive", 2);
  expectRefusal({l, r, "--calib", c, "--matcher", "magic"}, "magic", 2);
  expectRefusal({l, r, "--calib", c, "--block-size", "4"}, "odd", 2);
  expectRefusal({l, r, "--calib", c, "--clik", "3,4"}, "--clik", 2);
  expectRefusal({l, r, "--calib", c, "--segment", "none"}, "needs --roi", 2);
  expectRefusal({l, file("mask.png"), "--calib", c}, "nothing matches");
  const Folder folder;
  const std::string zero =
      folder.write("zero.txt", "f=811.6\ncx=319.5\ncy=239.5\nbaseline=0\n");
  expectRefusal({l, r, "--calib", zero}, "baseline is zero");
  const std::string other = folder.write(
      "other.txt",
      "f=811.6\ncx=319.5\ncy=239.5\nbaseline=0.1\nwidth=320\nheight=240\n");
  expectRefusal({l, r, "--calib", other}, "calibration is for");
}

TEST_F(StereoApp, AnEmptyMaskIsRefused) {
  const Folder folder;
  // a 1 x 1 portable grey map is the smallest image there is
  const std::string tiny = folder.write("tiny.pgm", "P2\n1 1\n255\n0\n");
  auto arguments = pair();
  arguments.insert(arguments.end(), {"--mask", tiny});
  expectRefusal(arguments, "differ in size");
  std::string black = "P5\n640 480\n255\n" + std::string(640 * 480, '\0');
  arguments.back() = folder.write("black.pgm", black);
  expectRefusal(arguments, "empty");
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
