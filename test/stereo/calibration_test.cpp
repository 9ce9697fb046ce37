// SPDX-License-Identifier: BSD-3-Clause
#include "folder.h"
#include "pcl_sq/stereo/stereo_calibration.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const char* const MIDDLEBURY = "cam0=[1000 0 320; 0 1000 240; 0 0 1]\n"
                               "cam1=[1000 0 350; 0 1000 240; 0 0 1]\n"
                               "doffs=30\nbaseline=120.5\nwidth=640\nheight=480\n";

/** \brief The message of the exception that reading a file gives; empty if none. */
std::string refusal(const std::string& text, const std::string& name = "calib.txt") {
  const Folder folder;
  try {
    (void)StereoCalibration::load(folder.write(name, text));
  } catch (const Exception& e) {
    return e.what();
  }
  return "";
}

void expectRefusal(const std::string& text,
                   const std::string& reason,
                   const std::string& name = "calib.txt") {
  EXPECT_NE(refusal(text, name).find(reason), std::string::npos)
      << "wanted '" << reason << "', got '" << refusal(text, name) << "'";
}

/** \brief A raw pair as OpenCV writes it. */
std::string rawYaml(const cv::Vec3d& t, const cv::Mat& m1 = {}) {
  cv::FileStorage out(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  const cv::Mat m = (cv::Mat_<double>(3, 3) << 800, 0, 320, 0, 800, 240, 0, 0, 1);
  out << "image_width" << 640 << "image_height" << 480;
  out << "M1" << (m1.empty() ? m : m1) << "D1" << cv::Mat::zeros(1, 5, CV_64F);
  out << "M2" << m << "D2" << cv::Mat::zeros(1, 5, CV_64F);
  out << "R" << cv::Mat::eye(3, 3, CV_64F) << "T" << cv::Mat(t);
  return out.releaseAndGetString();
}

} // namespace

TEST(StereoCalibration, ReadsMiddleburyInMillimetres) {
  const Folder folder;
  const auto c = StereoCalibration::load(folder.write("calib.txt", MIDDLEBURY));
  EXPECT_TRUE(c.isRectified());
  EXPECT_DOUBLE_EQ(c.getIntrinsics().baseline, 0.1205);
  EXPECT_DOUBLE_EQ(c.getIntrinsics().doffs, 30.0);
  EXPECT_NEAR(c.getIntrinsics().depth(70.0), 1000 * 0.1205 / 100.0, 1e-12);
}

TEST(StereoCalibration, ReadsPlainNumbersInAnyFormat) {
  const Folder folder;
  const std::string text = "f = 811.6\ncx=319.5\ncy=239.5\nbaseline=0.12\n";
  const std::string yaml =
      "%YAML:1.0\n---\nf: 811.6\ncx: 319.5\ncy: 239.5\nbaseline_m: 0.12\n";
  const std::string json =
      "{\"f\": 811.6, \"cx\": 319.5, \"cy\": 239.5, \"baseline\": 0.12}";
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{"a.txt", text},
        {"a.yml", yaml},
        {"a.json", json}}) {
    const auto c = StereoCalibration::load(folder.write(name, content));
    EXPECT_TRUE(c.isRectified()) << name;
    EXPECT_DOUBLE_EQ(c.getIntrinsics().fx, 811.6) << name;
    EXPECT_DOUBLE_EQ(c.getIntrinsics().baseline, 0.12) << name;
  }
}

TEST(StereoCalibration, RectifiesTheRawPairOfAnIdealRigToItself) {
  const Folder folder;
  auto c = StereoCalibration::load(folder.write("c.yml", rawYaml({-0.12, 0, 0})));
  EXPECT_FALSE(c.isRectified());
  EXPECT_NEAR(c.getIntrinsics().baseline, 0.12, 1e-9);
  EXPECT_NEAR(c.getIntrinsics().fx, 800.0, 1.0);
}

TEST(StereoCalibration, TheFilesUnitOfLengthIsAnOption) {
  const Folder folder;
  const std::string file = folder.write("c.yml", rawYaml({-120.0, 0, 0}));
  EXPECT_THROW((void)StereoCalibration::load(file), Exception); // 120 m
  EXPECT_NEAR(StereoCalibration::load(file, 1e-3).getIntrinsics().baseline, 0.12, 1e-9);
}

TEST(StereoCalibration, ReadsIntrinsicsAndExtrinsicsFromTwoFiles) {
  const Folder folder;
  const std::string both = rawYaml({-0.12, 0, 0});
  const std::size_t cut = both.find("R: ");
  const std::string first = folder.write("intrinsics.yml", both.substr(0, cut));
  const std::string second =
      folder.write("extrinsics.yml", "%YAML:1.0\n---\n" + both.substr(cut));
  EXPECT_NEAR(
      StereoCalibration::load({first, second}).getIntrinsics().baseline, 0.12, 1e-9);
  EXPECT_THROW((void)StereoCalibration::load(first), Exception); // R, T are missing
}

TEST(StereoCalibration, SaysWhatIsWrongWithAFile) {
  expectRefusal("", "is empty");
  expectRefusal("hello world\n", "neither YAML");
  expectRefusal("f=800\ncx=320\ncy=240\n", "baseline is missing");
  expectRefusal("f=800\ncx=320\ncy=240\nbaseline=0\n", "baseline is zero");
  expectRefusal("f=800\ncx=320\ncy=240\nbaseline=120\n", "not plausible");
  expectRefusal("f=800\ncx=320\ncy=240\nbaseline=-0.1\n", "exchange");
  expectRefusal("f=-800\ncx=320\ncy=240\nbaseline=0.1\n", "positive");
  expectRefusal("f=nan\ncx=320\ncy=240\nbaseline=0.1\n", "neither M1");
  expectRefusal("f=8x0\ncx=320\ncy=240\nbaseline=0.1\n", "not a number");
  expectRefusal("%YAML:1.0\n---\nM1: [\n", "not valid YAML at line 4", "c.yml");
  expectRefusal(rawYaml({0, 0, 0}), "baseline is zero", "c.yml");
  expectRefusal(rawYaml({0.12, 0, 0}), "exchange", "c.yml");
  expectRefusal(rawYaml({0.0, -0.12, 0}), "one above the other", "c.yml");
  expectRefusal(rawYaml({-0.12, 0, 0}, cv::Mat::eye(2, 2, CV_64F)), "M1", "c.yml");
  const cv::Mat bad = cv::Mat(3, 3, CV_64F, std::nan(""));
  expectRefusal(rawYaml({-0.12, 0, 0}, bad), "not finite", "c.yml");
  EXPECT_THROW((void)StereoCalibration::load("no/such/file.yml"), Exception);
  EXPECT_THROW((void)StereoCalibration::load(std::vector<std::string>{}), Exception);
}

TEST(StereoCalibration, RefusesImagesOfAnotherSize) {
  const Folder folder;
  auto c = StereoCalibration::load(folder.write("calib.txt", MIDDLEBURY));
  cv::Mat l, r;
  const cv::Mat good(480, 640, CV_8U, cv::Scalar(0)), small(240, 320, CV_8U);
  EXPECT_NO_THROW(c.rectify(good, good, l, r));
  const cv::Mat cut(400, 640, CV_8U);
  EXPECT_THROW(c.rectify(cut, cut, l, r), Exception);
  EXPECT_THROW(c.rectify(good, small, l, r), Exception);
  EXPECT_THROW(c.rectify(good, cv::Mat(), l, r), Exception);
  // a file without a size is told by its principal point
  auto unsized = StereoCalibration::load(
      folder.write("c.txt", "f=1310\ncx=511.5\ncy=383.5\nbaseline=0.12\n"));
  EXPECT_THROW(unsized.rectify(good, good, l, r), Exception);
}
