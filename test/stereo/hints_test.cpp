// SPDX-License-Identifier: BSD-3-Clause
// Hints on real, cluttered images; skipped where the data are not there.
#include "pcl_sq/stereo/object_segmenter.h"
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <filesystem>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const std::string REAL_DATA = PCL_SQ_TEST_DATA;

/** \brief An object in a real pair and a hint for it. */
struct Hint {
  const char* name;
  const char* pair;
  CellRect box; ///< drawn by hand, about 5 px
  int x, y;     ///< a pixel of the object
};

const Hint HINTS[] = {{"Mug", "adirondack", {340, 110, 58, 58}, 360, 145},
                      {"BookStack", "adirondack", {93, 263, 156, 113}, 180, 290},
                      {"BinWithLid", "recycle", {137, 0, 362, 485}, 300, 400},
                      {"Cone", "artl", {152, 140, 41, 70}, 172, 185},
                      {"Head", "artl", {55, 29, 118, 147}, 110, 60},
                      {"Crayon", "artl", {53, 207, 186, 60}, 190, 240}};

class RealHints : public ::testing::TestWithParam<Hint> {
protected:
  void SetUp() override {
    const std::string folder = REAL_DATA + "/stereo/" + GetParam().pair + "/";
    if (!std::filesystem::exists(folder))
      GTEST_SKIP() << "no data in " << folder;
    image_ = cv::imread(folder + "im0.png");
    StereoReprojector reprojector(StereoCalibration::load(folder + "calib.txt"));
    cloud_ = reprojector.compute(image_, cv::imread(folder + "im1.png")).cloud;
  }
  bool is(const std::string& name) const { return name == GetParam().name; }

  cv::Mat image_;
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud_;
  ObjectSegmenter segmenter_;
  Segment segment_;
};

} // namespace

TEST_P(RealHints, ABoxDrawnByHandGivesTheObject) {
  ASSERT_TRUE(segmenter_.segmentBox(image_, GetParam().box, *cloud_, segment_));
  EXPECT_GE(overlap(segment_.rect, GetParam().box), 0.9);
  // white paper before white plaster too: its depth tells
  EXPECT_TRUE(segment_.outlined);
}

TEST_P(RealHints, AClickGivesTheObject) {
  if (is("Crayon") || is("BookStack"))
    GTEST_SKIP() << "several things of several colours at one depth";
  ASSERT_TRUE(
      segmenter_.segmentClick(image_, GetParam().x, GetParam().y, *cloud_, segment_));
  EXPECT_GE(overlap(segment_.rect, GetParam().box), 0.8);
}

TEST_P(RealHints, ASeedColourGivesTheObjectThatHasItAlone) {
  if (!is("Mug") && !is("BinWithLid"))
    GTEST_SKIP() << "its colour is found elsewhere, too";
  const cv::Vec3b c = image_.at<cv::Vec3b>(GetParam().y, GetParam().x);
  ASSERT_TRUE(segmenter_.segmentColor(image_, c[2], c[1], c[0], segment_));
  EXPECT_GE(overlap(segment_.rect, GetParam().box), 0.9);
}

INSTANTIATE_TEST_SUITE_P(Data,
                         RealHints,
                         ::testing::ValuesIn(HINTS),
                         [](const auto& test) { return test.param.name; });

TEST(DepthHint, AClickOnABoxOfManyColoursGivesMoreOfItThanOneColour) {
  const std::string folder = REAL_DATA + "/clouds/rgbd_cheezit/";
  if (!std::filesystem::exists(folder))
    GTEST_SKIP() << "no data in " << folder;
  CameraIntrinsics k;
  k.fx = 616.3653;
  k.fy = 616.2029;
  k.cx = 310.2588;
  k.cy = 236.5998;
  const cv::Mat image = cv::imread(folder + "color.png");
  const cv::Mat depth = cv::imread(folder + "depth_0.1mm.png", cv::IMREAD_UNCHANGED);
  const StereoResult result = reprojectDepth(depth, 1e-4, k, image);
  ObjectSegmenter segmenter;
  Segment colour, both;
  ASSERT_TRUE(segmenter.segmentClick(image, 420, 200, colour));
  ASSERT_TRUE(segmenter.segmentClick(image, 420, 200, *result.cloud, both));
  EXPECT_GT(cv::countNonZero(both.mask), 2 * cv::countNonZero(colour.mask));
  EXPECT_LT(cv::countNonZero(both.mask), 0.2 * static_cast<double>(both.mask.total()));
}
