// SPDX-License-Identifier: BSD-3-Clause
// Calibrations that would be misread in silence.
#include "calibration_texts.h"
#include "rig_formats.h"
#include "text.h"

#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(CalibrationDoubts, AFisheyeIsNoPinholeWhateverTheNameThatSaysSo) {
  const Rig rig;
  const std::string good = rig.lists("K1", "K2", "D1", "D2", "R", "T");
  const auto fx = [](const std::string& text) {
    return loadText(text).getIntrinsics().fx;
  };
  const double fisheye = fx("distortion_model: equidistant\n" + good);
  const double pinhole = fx(good);
  ASSERT_GT(std::abs(fisheye - pinhole), 1.0);
  for (const char* line : {"fisheye: true",
                           "fisheye: yes",
                           "is_fisheye: on",
                           "fisheye: 1",
                           "fisheye_model: 1",
                           "projection: equidistant",
                           "lens_type: fisheye",
                           "type: fisheye",
                           "lens: equidistant",
                           "calibration: {lens: Kannala-Brandt}",
                           "distortion_left: equidistant",
                           "model: fisheye"})
    EXPECT_DOUBLE_EQ(fx(std::string(line) + "\n" + good), fisheye) << line;
  for (const char* line : {"fisheye: false",
                           "fisheye: no",
                           "fisheye: 0",
                           "camera_name: fisheye",
                           "left_image: /data/fisheye/left.png",
                           "model: OAK-D"})
    EXPECT_DOUBLE_EQ(fx(std::string(line) + "\n" + good), pinhole) << line;
  expectFormatRefusal("lens: Fisheye624\n" + good, "'Fisheye624' is not known");
}

TEST(CalibrationDoubts, TheUnitOfLengthCountsForKalibrAndEurocToo) {
  Rig rig;
  rig.T *= 1000.0; // of a board whose squares were given in millimetres
  for (const char* name : {"Kalibr", "EuRoC"}) {
    SCOPED_TRACE(name);
    const Texts texts = rig.formats().at(name);
    EXPECT_NE(refusalOfTexts(texts).find("--calib-unit"), std::string::npos);
    const StereoCalibration c = StereoCalibration::fromText(texts, 0.001);
    EXPECT_NEAR(c.getIntrinsics().baseline, 1e-3 * cv::norm(rig.T), 1e-9);
  }
}

TEST(CalibrationDoubts, ABaselineThatIsToldTwiceIsTheSameOrRefused) {
  const Rig rig;
  const double b = cv::norm(rig.T), f = rig.P2.at<double>(0, 0);
  const std::string good = rig.lists("K1", "K2", "D1", "D2", "R", "T");
  const auto projections = [&](double baseline) {
    cv::Mat p2 = rig.P2.clone();
    p2.at<double>(0, 3) = -f * baseline;
    return "R1: [" + rig.list(rig.R1) + "]\nR2: [" + rig.list(rig.R2) + "]\nP1: [" +
           rig.list(rig.P1) + "]\nP2: [" + rig.list(p2) + "]\n";
  };
  const auto q = [&](double baseline) {
    cv::Mat m = rig.Q.clone();
    m.at<double>(3, 2) = 1.0 / baseline;
    return "Q: [" + rig.list(m) + "]\n";
  };
  const auto number = [&](double baseline) {
    return "baseline: " + rig.number(baseline) + "\n";
  };
  const auto orbSlam = [&](double baseline) {
    return "Camera.fx: 400\nCamera.bf: " + rig.number(400.0 * baseline) + "\n";
  };
  EXPECT_NO_THROW(
      (void)loadText(good + projections(b) + q(-b) + number(1.01 * b) + orbSlam(b)));
  expectFormatRefusal(good + projections(0.09),
                      "T says that the baseline is 0.0800106 m, but P2 says 0.09 m");
  expectFormatRefusal(good + q(0.09), "but Q says 0.09 m");
  expectFormatRefusal(good + number(0.09), "but baseline says 0.09 m");
  expectFormatRefusal(good + orbSlam(0.09), "but bf / fx says 0.09 m");
  // of a rectified pair, and whatever the unit
  expectFormatRefusal(projections(0.06) + number(0.09), "P2 says that the baseline is");
  EXPECT_NE(refusalOfTexts({{"file", q(60.0) + number(90.0)}}, 0.001)
                .find("Q says that the baseline is 0.06 m, but baseline says 0.09 m"),
            std::string::npos);
}

TEST(CalibrationDoubts, CommentsOfIniFilesAreNoValues) {
  const Rig rig;
  const std::string zed = rig.formats().at("ZED")[0].text;
  std::string text = "; made by hand\n// twice\n# thrice\n" + zed;
  text = replaced(text, "[LEFT_CAM_VGA]", "[LEFT_CAM_VGA] ; the small one");
  text = replaced(text, "\nTY=", "\n; TY of the right camera\nTY=");
  text = replaced(text, "\nTZ=", " ; in millimetres\nTZ=");
  const auto read = [](const std::string& file) {
    return StereoCalibration::fromText({{"SN1.conf", file}}, 1.0, 672, 376);
  };
  const StereoIntrinsics with = read(text).getIntrinsics();
  const StereoIntrinsics without = read(zed).getIntrinsics();
  EXPECT_DOUBLE_EQ(with.baseline, without.baseline);
  EXPECT_DOUBLE_EQ(with.fx, without.fx);
  EXPECT_DOUBLE_EQ(with.cy, without.cy);
  EXPECT_NEAR(loadText("; f in pixels\nf=500 # of both\ncx=199.5\ncy=149.5\n"
                       "baseline=0.06\n")
                  .getIntrinsics()
                  .fx,
              500.0,
              1e-12);
}
