// SPDX-License-Identifier: BSD-3-Clause
#include "calibration_texts.h"
#include "rig_formats.h"
#include "text.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <clocale>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Pixel coordinates as an image of two channels: after rectifying they tell
 * where each pixel came from. */
cv::Mat coordinates(const cv::Size& size) {
  cv::Mat image(size, CV_32FC2);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u)
      image.at<cv::Vec2f>(v, u) = {float(u), float(v)};
  return image;
}

/** \brief Where the rectified pixels of both cameras come from. */
std::pair<cv::Mat, cv::Mat> sources(StereoCalibration& c, const cv::Size& size) {
  const cv::Mat image = coordinates(size);
  std::pair<cv::Mat, cv::Mat> result;
  c.rectify(image, image, result.first, result.second);
  return result;
}

/** \brief Value between pixels. */
cv::Vec2f at(const cv::Mat& image, const Eigen::Vector2d& pixel) {
  const cv::Mat u(1, 1, CV_32F, cv::Scalar(pixel.x()));
  const cv::Mat v(1, 1, CV_32F, cv::Scalar(pixel.y()));
  cv::Mat value;
  cv::remap(image, value, u, v, cv::INTER_LINEAR);
  return value.at<cv::Vec2f>(0, 0);
}

} // namespace

TEST(CalibrationFormats, EveryFormatOfARawRigGivesTheSameRectification) {
  const Rig rig;
  StereoCalibration reference =
      StereoCalibration::fromText(rig.formats().at("OpenCV YAML"));
  const auto wanted = sources(reference, rig.size);
  for (const auto& [name, texts] : rig.formats()) {
    SCOPED_TRACE(name);
    StereoCalibration c = StereoCalibration::fromText(
        texts, 1.0, name == "ZED" ? 672 : rig.size.width, name == "ZED" ? 376 : 300);
    if (name == "ZED") // its sections are for sizes of that camera alone
      continue;
    const auto got = sources(c, rig.size);
    EXPECT_NEAR(c.getIntrinsics().baseline, reference.getIntrinsics().baseline, 1e-9);
    EXPECT_NEAR(c.getIntrinsics().fx, reference.getIntrinsics().fx, 1e-6);
    EXPECT_NEAR(c.getIntrinsics().cx, reference.getIntrinsics().cx, 1e-6);
    EXPECT_NEAR(c.getIntrinsics().doffs, 0.0, 1e-9);
    EXPECT_LT(cv::norm(got.first, wanted.first, cv::NORM_INF), 1e-2);
    EXPECT_LT(cv::norm(got.second, wanted.second, cv::NORM_INF), 1e-2);
    EXPECT_TRUE(c.getNotes().empty());
  }
}

TEST(CalibrationFormats, ZedsSectionIsChosenByTheImagesSize) {
  const Rig rig;
  const Texts texts = rig.formats().at("ZED");
  const cv::Size vga(672, 376);
  StereoCalibration c = StereoCalibration::fromText(texts, 1.0, vga.width, vga.height);
  std::string lists =
      replaced(rig.lists("K1", "K2", "D1", "D2", "R", "T"), "[400, 300]", "[672, 376]");
  StereoCalibration same = loadText(lists);
  const auto got = sources(c, vga), wanted = sources(same, vga);
  EXPECT_LT(cv::norm(got.first, wanted.first, cv::NORM_INF), 1e-2);
  EXPECT_LT(cv::norm(got.second, wanted.second, cv::NORM_INF), 1e-2);
  EXPECT_NEAR(c.getIntrinsics().baseline, cv::norm(rig.T), 1e-9);
  EXPECT_NE(refusalOfTexts(texts).find("HD, VGA"), std::string::npos); // which one?
  try {
    (void)StereoCalibration::fromText(texts, 0.001, vga.width, vga.height);
    ADD_FAILURE() << "a unit for a file that has its own";
  } catch (const Exception& e) {
    EXPECT_NE(std::string(e.what()).find("a unit of length of their own"),
              std::string::npos);
  }
}

TEST(CalibrationFormats, EveryFormatOfARectifiedPairGivesTheSameNumbers) {
  const std::string p1 = "P1: [500, 0, 199.5, 0, 0, 500, 149.5, 0, 0, 0, 1, 0]\n";
  const std::string p2 = "P2: [500, 0, 203.5, -30, 0, 500, 149.5, 0, 0, 0, 1, 0]\n";
  const std::map<std::string, std::string> formats = {
      {"projections", p1 + p2},
      {"offset on the left one",
       "P1: [500, 0, 199.5, 30, 0, 500, 149.5, 0, 0, 0, 1, 0]\n"
       "P2: [500, 0, 203.5, 0, 0, 500, 149.5, 0, 0, 0, 1, 0]\n"},
      {"offsets on both",
       "P_left: [500, 0, 199.5, 10, 0, 500, 149.5, 0, 0, 0, 1, 0]\n"
       "P_right: [500, 0, 203.5, -20, 0, 500, 149.5, 0, 0, 0, 1, 0]\n"},
      {"rows",
       "P0: 500 0 199.5 0 0 500 149.5 0 0 0 1 0\n"
       "P1: 500 0 203.5 -30 0 500 149.5 0 0 0 1 0\n"},
      {"Q",
       "Q: [[1, 0, 0, -199.5], [0, 1, 0, -149.5], [0, 0, 0, 500],\n"
       "  [0, 0, 16.666666666666668, 66.666666666666671]]\n"},
      {"lines", "fx=500\nfy=500\ncx=199.5\ncy=149.5\nbaseline=0.06\ndoffs=4\n"},
      {"Middlebury",
       "cam0=[500 0 199.5; 0 500 149.5; 0 0 1]\ncam1=[500 0 203.5; 0 500 149.5; 0 0 "
       "1]\n"
       "baseline=60\n"},
      {"ORB-SLAM",
       "Camera.fx: 500.0\nCamera.fy: 500.0\nCamera.cx: 199.5\n"
       "Camera.cy: 149.5\nCamera.bf: 30.0\nCamera.k1: 0.0\ndoffs: 4\n"}};
  for (const auto& [name, text] : formats) {
    SCOPED_TRACE(name);
    const StereoCalibration c = loadText(text);
    const StereoIntrinsics& k = c.getIntrinsics();
    EXPECT_TRUE(c.isRectified());
    EXPECT_NEAR(k.fx, 500.0, 1e-9);
    EXPECT_NEAR(k.fy, 500.0, 1e-9);
    EXPECT_NEAR(k.cx, 199.5, 1e-9);
    EXPECT_NEAR(k.cy, 149.5, 1e-9);
    EXPECT_NEAR(k.baseline, 0.06, 1e-12);
    EXPECT_NEAR(k.doffs, 4.0, 1e-9);
  }
}

TEST(CalibrationFormats, FisheyesAreRectifiedToWhatCvFisheyeProjects) {
  Rig rig;
  rig.K1 = (cv::Mat_<double>(3, 3) << 180, 0, 199, 0, 181, 150, 0, 0, 1);
  rig.K2 = (cv::Mat_<double>(3, 3) << 182, 0, 201, 0, 182, 148, 0, 0, 1);
  rig.D1 = (cv::Mat_<double>(1, 4) << -0.02, 0.004, -0.001, 0.0002);
  rig.D2 = (cv::Mat_<double>(1, 4) << 0.01, -0.003, 0.001, -0.0001);
  const std::string named =
      "distortion_model: equidistant\n" + rig.lists("K1", "K2", "D1", "D2", "R", "T");
  for (const std::string& text : {named, rig.kalibr("equidistant")}) {
    StereoCalibration c = loadText(text);
    const auto from = sources(c, rig.size);
    const StereoIntrinsics& k = c.getIntrinsics();
    cv::Mat r1, r2, p1, p2, q;
    cv::fisheye::stereoRectify(rig.K1,
                               rig.D1.t(),
                               rig.K2,
                               rig.D2.t(),
                               rig.size,
                               rig.R,
                               rig.T,
                               r1,
                               r2,
                               p1,
                               p2,
                               q,
                               cv::CALIB_ZERO_DISPARITY,
                               rig.size);
    for (const cv::Vec3d& p : {cv::Vec3d(0.1, 0.05, 0.8), cv::Vec3d(-0.4, -0.2, 0.7)}) {
      const std::vector<cv::Point3d> point = {cv::Point3d(p[0], p[1], p[2])};
      std::vector<cv::Point2d> left, right;
      cv::Mat turn;
      cv::Rodrigues(rig.R, turn);
      cv::fisheye::projectPoints(
          point, left, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), rig.K1, rig.D1.t());
      cv::fisheye::projectPoints(
          point, right, cv::Vec3d(turn), cv::Vec3d(rig.T), rig.K2, rig.D2.t());
      const cv::Mat turned = r1 * cv::Mat(p);
      const Eigen::Vector3d own(
          turned.at<double>(0), turned.at<double>(1), turned.at<double>(2));
      const Eigen::Vector2d pixel = k.project(own);
      const double d = k.disparity(own.z());
      const cv::Vec2f l = at(from.first, pixel);
      const cv::Vec2f r = at(from.second, pixel - Eigen::Vector2d(d, 0.0));
      EXPECT_NEAR(l[0], left[0].x, 0.05);
      EXPECT_NEAR(l[1], left[0].y, 0.05);
      EXPECT_NEAR(r[0], right[0].x, 0.05);
      EXPECT_NEAR(r[1], right[0].y, 0.05);
    }
  }
}

TEST(CalibrationFormats, WhatIsNotUnderstoodIsRefusedByItsName) {
  const Rig rig;
  const std::string good = rig.lists("K1", "K2", "D1", "D2", "R", "T");
  expectFormatRefusal(good + "Z1: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n", "'Z1' (3 x 3)");
  expectFormatRefusal("distortion_model: omnidirectional\n" + good,
                      "'omnidirectional'");
  expectFormatRefusal(good + "xi: 1.2\n", "omnidirectional");
  expectFormatRefusal("distortion_model: equidistant\n" +
                          replaced(good, rig.list(rig.D1), "0, 0, 0, 0, 0"),
                      "equidistant (fisheye) model has 4");
  expectFormatRefusal(replaced(good, rig.list(rig.D1), "0, 0, 0, 0, 0, 0"),
                      "6 coefficients");
  expectFormatRefusal(rig.kalibr("fov"), "'fov'");
  expectFormatRefusal(
      replaced(rig.kalibr(), "camera_model: pinhole", "camera_model: omni"), "'omni'");
  expectFormatRefusal("f: 500\ncx: 199.5\ncy: 149.5\nbaseline: .06\nk1: -0.2\n",
                      "distortion k1");
  expectFormatRefusal(
      "f: 500\ncx: 199.5\ncy: 149.5\nbaseline: .06\nD1: [-0.2, 0, 0, 0]\n",
      "D1 is given without");
  expectFormatRefusal(good + "M1: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n", "contradict");
  expectFormatRefusal(good + "K1: 3\n", "K1 twice");
  expectFormatRefusal(rig.cameraInfo(rig.K1, rig.D1, rig.R1, rig.P1),
                      "describes one camera");
  expectFormatRefusal(replaced(good, rig.list(rig.T), "-80, 0, 0"), "not plausible");
  expectFormatRefusal(replaced(good, "\nT: ", "\n# "), "T is missing");
}

TEST(CalibrationFormats, RefusesTextThatNestsOrRepeatsWithoutEnd) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string deep = bracket[0] == '{' ? "" : "P1: ";
    for (int i = 0; i < 40000; ++i)
      deep += bracket;
    expectFormatRefusal(deep, "file");
  }
  std::string xml;
  for (int i = 0; i < 40000; ++i)
    xml += "<a>";
  expectFormatRefusal("<?xml version=\"1.0\"?>" + xml, "nests");
  std::string laughs = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string old = "*a" + std::to_string(i - 1);
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + old;
    for (int k = 0; k < 8; ++k)
      laughs += ", " + old;
    laughs += "]\n";
  }
  expectFormatRefusal(laughs, "repeats too much");
}

TEST(CalibrationFormats, WhatIsAssumedIsSaid) {
  const Rig rig;
  const std::string good = rig.lists("K1", "K2", "D1", "D2", "R", "T");
  const auto note = [](const StereoCalibration& c) {
    return c.getNotes().empty() ? std::string() : c.getNotes().front();
  };
  EXPECT_NE(note(loadText(replaced(good, "\nR: ", "\n# "))).find("no R"),
            std::string::npos);
  const std::string bare = replaced(replaced(good, "\nD1: ", "\n# "), "\nD2: ", "\n# ");
  EXPECT_NE(note(loadText(bare)).find("no distortion"), std::string::npos);
}

TEST(CalibrationFormats, ACalibrationIsScaledToImagesOfItsProportions) {
  const Rig rig;
  const std::string text = rig.lists("K1", "K2", "D1", "D2", "R", "T");
  StereoCalibration full = loadText(text), half = loadText(text);
  const cv::Size small(200, 150);
  const auto whole = sources(full, rig.size), scaled = sources(half, small);
  EXPECT_NEAR(half.getIntrinsics().fx, 0.5 * full.getIntrinsics().fx, 0.5);
  EXPECT_NEAR(half.getIntrinsics().baseline, full.getIntrinsics().baseline, 1e-6);
  ASSERT_EQ(half.getNotes().size(), 1u);
  EXPECT_NE(half.getNotes()[0].find("scaled"), std::string::npos);
  const cv::Vec2f a = whole.first.at<cv::Vec2f>(150, 200);
  const cv::Vec2f b = at(scaled.first, {(200.5) / 2 - 0.5, (150.5) / 2 - 0.5});
  EXPECT_NEAR((a[0] + 0.5) / 2 - 0.5, b[0], 0.1);
  EXPECT_NEAR((a[1] + 0.5) / 2 - 0.5, b[1], 0.1);
}

TEST(CalibrationFormats, TheLocaleOfAHostProgramChangesNothing) {
  struct Restore {
    ~Restore() { std::setlocale(LC_ALL, "C"); }
  } restore;
  bool found = false;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
    found = found || std::setlocale(LC_ALL, name) != nullptr;
  if (!found)
    GTEST_SKIP() << "no locale with decimal commas is installed";
  EXPECT_DOUBLE_EQ(
      loadText("f=500.25\ncx=199.5\ncy=149.5\nbaseline=0.06\n").getIntrinsics().fx,
      500.25);
}
