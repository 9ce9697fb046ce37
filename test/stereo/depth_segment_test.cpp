// SPDX-License-Identifier: BSD-3-Clause
// What depth tells of a box where colours say nothing: all is one grey with its noise.
#include "pcl_sq/stereo/object_segmenter.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

using namespace pcl_sq;

namespace {

constexpr int WIDTH = 240, HEIGHT = 180;
constexpr float FOCAL = 500.0F, WALL = 1.5F, THING = 1.0F;

/** \brief A depth image as a cloud, and a picture of one colour. */
class DepthSegment : public ::testing::Test {
protected:
  DepthSegment() : depth_(HEIGHT, WIDTH, CV_32F, cv::Scalar(WALL)) {}

  /** \brief A fold is told to half a window: a tenth of the thing. */
  void expectTheThing(const CellRect& box) {
    cv::Mat grey(HEIGHT, WIDTH, CV_8U);
    cv::RNG dice(1);
    dice.fill(grey, cv::RNG::NORMAL, 120, 6);
    pcl::PointCloud<pcl::PointXYZRGB> cloud(WIDTH, HEIGHT);
    for (int v = 0; v < HEIGHT; ++v)
      for (int u = 0; u < WIDTH; ++u) {
        const float z = depth_.at<float>(v, u);
        auto& p = cloud.at(u, v);
        p.x = (float(u) - 0.5F * WIDTH) / FOCAL * z;
        p.y = (float(v) - 0.5F * HEIGHT) / FOCAL * z;
        p.z = z;
      }
    ObjectSegmenter segmenter;
    Segment segment;
    ASSERT_TRUE(segmenter.segmentBox(grey, box, cloud, segment));
    EXPECT_TRUE(segment.outlined);
    cv::Mat thing = cv::Mat::zeros(HEIGHT, WIDTH, CV_8U);
    thing(thing_).setTo(255);
    const double common = cv::countNonZero(segment.mask & thing);
    EXPECT_GT(common / cv::countNonZero(segment.mask | thing), 0.8);
  }

  cv::Mat depth_;
  const cv::Rect thing_{90, 50, 70, 80};
};

} // namespace

TEST_F(DepthSegment, ADrumBeforeAThingIsNoPartOfItThoughMatchingSmearsTheStep) {
  constexpr int SMEARED = 9; // as wide as the windows in which disparities are refined
  constexpr float DRUM = 0.93F, BULGE = 0.1F;
  depth_(thing_).setTo(THING);
  for (int v = 30; v < HEIGHT; ++v)
    for (int u = 0; u < thing_.x + SMEARED / 2; ++u) {
      const float t =
          std::clamp(float(u - thing_.x + SMEARED / 2) / float(SMEARED), 0.0F, 1.0F);
      const bool beside = v >= thing_.y && v < thing_.y + thing_.height;
      const float drum =
          DRUM - BULGE * std::sin(float(M_PI) * std::min(1.0F, float(u) / 94.0F));
      depth_.at<float>(v, u) = drum + (beside ? t * (THING - drum) : 0.0F);
    }
  expectTheThing({70, 46, 94, 88});
}

TEST_F(DepthSegment, WhatAThingStandsBehindEndsAtTheFoldBetweenThem) {
  depth_(thing_).setTo(THING);
  const int foot = thing_.y + thing_.height;
  for (int v = foot; v < HEIGHT; ++v) // bulges towards the camera
    for (int u = 20; u < 220; ++u)
      depth_.at<float>(v, u) =
          THING - 0.12F * std::sin(float(v - foot) / float(HEIGHT - foot) * 1.57F);
  expectTheThing({86, 46, 78, 104});
}

TEST_F(DepthSegment, PiecesOfAThingThatAnotherPartsAreBothIn) {
  // it goes back as a thing does that lies askew, and a stick stands before it
  for (int v = thing_.y; v < thing_.y + thing_.height; ++v)
    for (int u = thing_.x; u < thing_.x + thing_.width; ++u)
      depth_.at<float>(v, u) = THING - 0.001F * float(u - thing_.x);
  depth_(cv::Rect(108, 10, 5, 160)).setTo(0.8F);
  expectTheThing({86, 46, 78, 88});
}
