// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/histogram_plot.h"
#include "pcl_sq/stereo/object_segmenter.h"
#include "pcl_sq/stereo/texture_border_filter.h"
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const StereoScene& can() {
  static const StereoScene scene = renderScene("can");
  return scene;
}

CellRect around(const CellRect& r, int margin) {
  return {r.x - margin, r.y - margin, r.width + 2 * margin, r.height + 2 * margin};
}

double maskOverlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

class ObjectSegmenterMethods : public ::testing::TestWithParam<SegmentMethod> {
protected:
  void SetUp() override {
    SegmenterOptions options;
    options.method = GetParam();
    segmenter_.setOptions(options);
  }
  void expectTheCan() const {
    EXPECT_GT(overlap(segment_.rect, can().roi), 0.9);
    EXPECT_GT(maskOverlap(segment_.mask, can().mask), 0.9);
  }
  ObjectSegmenter segmenter_;
  Segment segment_;
};

} // namespace

TEST_P(ObjectSegmenterMethods, FindsTheObjectInABox) {
  ASSERT_TRUE(segmenter_.segmentBox(can().left, around(can().roi, 8), segment_));
  expectTheCan();
}

TEST_P(ObjectSegmenterMethods, FindsTheObjectUnderAPixel) {
  const CellRect& r = can().roi;
  ASSERT_TRUE(segmenter_.segmentClick(
      can().left, r.x + r.width / 2, r.y + r.height / 2, segment_));
  expectTheCan();
}

TEST_P(ObjectSegmenterMethods, FindsTheObjectOfAColour) {
  const cv::Scalar mean = cv::mean(can().left, can().mask);
  ASSERT_TRUE(segmenter_.segmentColor(can().left,
                                      static_cast<int>(mean[2]),
                                      static_cast<int>(mean[1]),
                                      static_cast<int>(mean[0]),
                                      segment_));
  expectTheCan();
}

TEST_P(ObjectSegmenterMethods, GivesTheSameMaskTwice) {
  Segment again;
  ASSERT_TRUE(segmenter_.segmentBox(can().left, around(can().roi, 8), segment_));
  ASSERT_TRUE(segmenter_.segmentBox(can().left, around(can().roi, 8), again));
  EXPECT_EQ(cv::countNonZero(segment_.mask != again.mask), 0);
}

INSTANTIATE_TEST_SUITE_P(Methods,
                         ObjectSegmenterMethods,
                         ::testing::Values(SegmentMethod::COLOR,
                                           SegmentMethod::GRABCUT));

TEST(ObjectSegmenter, FindsWhatStandsOnTheTableWithoutAHint) {
  const auto cloud = reprojectDisparity(can().disparity, can().left, can().intrinsics);
  ObjectSegmenter segmenter;
  Segment segment;
  ASSERT_TRUE(segmenter.segmentTabletop(can().left, *cloud, segment));
  EXPECT_GT(overlap(segment.rect, can().roi), 0.9);
}

TEST(ObjectSegmenter, SaysWhyThereIsNothing) {
  ObjectSegmenter segmenter;
  Segment segment;
  EXPECT_FALSE(segmenter.segmentBox(can().left, {400, 10, 20, 20}, segment));
  EXPECT_NE(segmenter.getFailure().find("outside"), std::string::npos);
  EXPECT_FALSE(segmenter.segmentBox(can().left, {0, 0, 0, 0}, segment));
  EXPECT_FALSE(segmenter.segmentBox(can().left, {0, 0, 320, 240}, segment));
  EXPECT_NE(segmenter.getFailure().find("smaller"), std::string::npos);
  EXPECT_FALSE(segmenter.segmentClick(can().left, -1, 5, segment));
  EXPECT_FALSE(segmenter.segmentColor(can().left, 255, 0, 255, segment));
  EXPECT_FALSE(segmenter.segmentBox(cv::Mat(), {0, 0, 5, 5}, segment));
  pcl::PointCloud<pcl::PointXYZRGB> empty;
  EXPECT_FALSE(segmenter.segmentTabletop(can().left, empty, segment));
  EXPECT_TRUE(segment.mask.empty());
}

TEST(TextureBorderFilter, DropsTheRimAndKeepsTheMiddle) {
  const auto cloud = reprojectDisparity(can().disparity, can().left, can().intrinsics);
  cv::Mat fat; // a mask as a block matcher sees the object
  cv::dilate(can().mask, fat, cv::getStructuringElement(cv::MORPH_RECT, {11, 11}));
  TextureBorderFilter filter;
  filter.setInputCloud(cloud);
  filter.setMask(fat);
  filter.setBlockSize(15);
  pcl::Indices kept;
  filter.filter(kept);
  int background = 0, object = 0;
  for (const pcl::index_t i : kept)
    (can().mask.ptr<std::uint8_t>()[i] != 0 ? object : background)++;
  const int rim = cv::countNonZero(fat) - cv::countNonZero(can().mask);
  EXPECT_GT(object, 0.8 * cv::countNonZero(can().mask));
  EXPECT_LT(background, 0.3 * rim);
}

TEST(TextureBorderFilter, KeepsPclsContract) {
  auto cloud = reprojectDisparity(can().disparity, can().left, can().intrinsics);
  cloud->at(can().roi.x + 20, can().roi.y + 20).x = std::nanf("");
  TextureBorderFilter filter(true);
  filter.setInputCloud(cloud);
  filter.setMask(can().mask);
  pcl::Indices kept, others;
  filter.filter(kept);
  EXPECT_EQ(kept.size() + filter.getRemovedIndices()->size(), cloud->size() - 1);
  filter.setNegative(true);
  filter.filter(others);
  EXPECT_EQ(kept.size() + others.size(), cloud->size() - 1);
  filter.setBlockSize(4); // refused
  EXPECT_EQ(filter.getBlockSize(), 15);
  filter.setMask(cv::Mat());
  filter.filter(kept);
  EXPECT_TRUE(kept.empty());
}

TEST(PlotDepthHistogram, ColoursTheApertureOnly) {
  DepthHistogram h;
  h.bin_width = 0.01;
  h.counts = {0, 5, 0, 0, 40, 60, 50, 0, 0, 7};
  h.first_bin = 4;
  h.last_bin = 6;
  const cv::Mat with = plotDepthHistogram(h);
  h.last_bin = h.first_bin - 1;
  const cv::Mat without = plotDepthHistogram(h);
  EXPECT_EQ(with.size(), cv::Size(640, 400));
  EXPECT_GT(cv::norm(with, without, cv::NORM_L1), 0.0);
  EXPECT_EQ(plotDepthHistogram(DepthHistogram()).size(), cv::Size(640, 400));
}
