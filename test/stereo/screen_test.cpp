// SPDX-License-Identifier: BSD-3-Clause
// A thing before a wall of its own colour, and another that comes into its box.
#include "pcl_sq/stereo/object_segmenter.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

using namespace pcl_sq;

namespace {

constexpr int SCREEN_WIDTH = 320, SCREEN_HEIGHT = 200;
const cv::Rect FRAMED(120, 40, 120, 120); ///< 1.15 m away
const cv::Rect BOARD(0, 30, 150, 140);    ///< darker, 1.06 to 1.09 m

cv::Mat image() {
  cv::Mat gray(SCREEN_HEIGHT, SCREEN_WIDTH, CV_8U, cv::Scalar(150));
  gray(FRAMED).setTo(150);
  gray(BOARD).setTo(70);
  cv::Mat noise(gray.size(), CV_8U), bgr;
  cv::theRNG().state = 7;
  cv::randu(noise, 0, 30);
  gray += noise;
  cv::cvtColor(gray, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

pcl::PointCloud<pcl::PointXYZRGB> cloud() {
  pcl::PointCloud<pcl::PointXYZRGB> points(SCREEN_WIDTH, SCREEN_HEIGHT);
  for (int v = 0; v < SCREEN_HEIGHT; ++v)
    for (int u = 0; u < SCREEN_WIDTH; ++u) {
      pcl::PointXYZRGB& p = points.at(u, v);
      p.z = FRAMED.contains({u, v}) ? 1.15F : 2.0F;
      if (BOARD.contains({u, v})) {
        p.z = 1.06F + 2e-4F * float(u);
        if (u >= BOARD.width - 8) // matching blurs the step
          p.z += 0.0075F * float(u - BOARD.width + 9);
      }
      p.x = 0.001F * float(u) * p.z;
      p.y = 0.001F * float(v) * p.z;
    }
  return points;
}

} // namespace

TEST(ObjectSegmenter, LeavesOutWhatComesIntoTheBoxFromBesideIt) {
  ObjectSegmenter segmenter;
  Segment segment;
  ASSERT_TRUE(segmenter.segmentBox(
      image(), {FRAMED.x, FRAMED.y, FRAMED.width, FRAMED.height}, cloud(), segment));
  const cv::Rect left(FRAMED.x, FRAMED.y + 5, 20, FRAMED.height - 10),
      right(160, FRAMED.y + 5, 70, FRAMED.height - 10);
  EXPECT_LT(cv::countNonZero(segment.mask(left)), 0.1 * left.area());
  EXPECT_GT(cv::countNonZero(segment.mask(right)), 0.9 * right.area());
}
