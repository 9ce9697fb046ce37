// SPDX-License-Identifier: BSD-3-Clause
// A piece of a surface has no edges of its own, a thing has.
#include "stereo/pipeline/outline_edges.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::detail;

namespace {

constexpr int BOARD_WIDTH = 200, BOARD_HEIGHT = 160;
constexpr float NOISE = 0.1F; // [px]
const cv::Rect BOX(60, 50, 70, 50);

/** \brief A slanted wall, with the matcher's noise. */
StereoResult wall() {
  StereoResult stereo;
  stereo.disparity = cv::Mat(BOARD_HEIGHT, BOARD_WIDTH, CV_32F);
  cv::theRNG().state = 3;
  cv::randn(stereo.disparity, 0.0, NOISE);
  stereo.disparity_sigma =
      cv::Mat(BOARD_HEIGHT, BOARD_WIDTH, CV_32F, cv::Scalar(NOISE));
  for (int v = 0; v < BOARD_HEIGHT; ++v)
    for (int u = 0; u < BOARD_WIDTH; ++u)
      stereo.disparity.at<float>(v, u) += 40.0F + 0.03F * float(u) - 0.1F * float(v);
  return stereo;
}

cv::Mat maskOf(const cv::Rect& box) {
  cv::Mat mask = cv::Mat::zeros(BOARD_HEIGHT, BOARD_WIDTH, CV_8U);
  mask(box).setTo(255);
  return mask;
}

} // namespace

TEST(OutlineEdges, ABoxDrawnOntoAWallHoldsAPieceOfIt) {
  const OutlineEdges edges = outlineEdges(wall(), maskOf(BOX));
  EXPECT_GT(edges.own, 0.95);
  EXPECT_GT(edges.goes_on, 0.95);
  EXPECT_TRUE(edges.isPiece());
}

TEST(OutlineEdges, WhatStandsBeforeAWallEndsAtItsOutline) {
  for (const double before : {1.0, 3.0, 20.0}) { // [px]
    StereoResult stereo = wall();
    stereo.disparity(BOX) += before;
    const OutlineEdges edges = outlineEdges(stereo, maskOf(BOX));
    EXPECT_LT(edges.goes_on, 0.05) << before;
    EXPECT_FALSE(edges.isPiece()) << before;
  }
}

TEST(OutlineEdges, WhatStandsOnATableMayGoOnAtItsFoot) {
  StereoResult stereo = wall();
  stereo.disparity(BOX) += 5.0;
  const cv::Rect below(BOX.x - 20, BOX.br().y, BOX.width + 40, 40);
  stereo.disparity(below) += 5.0; // as the box's front does
  const OutlineEdges edges = outlineEdges(stereo, maskOf(BOX));
  EXPECT_GT(edges.goes_on, 0.15);
  EXPECT_FALSE(edges.isPiece());
}

TEST(OutlineEdges, WhatHidesAWallIsNoEdgeOfIt) {
  StereoResult stereo = wall();
  stereo.disparity(cv::Rect(0, BOX.br().y, BOARD_WIDTH, 40)) += 30.0;
  stereo.disparity(cv::Rect(0, 0, BOX.x, BOARD_HEIGHT)) += 30.0;
  const OutlineEdges edges = outlineEdges(stereo, maskOf(BOX));
  EXPECT_LT(edges.own, 0.6);
  EXPECT_TRUE(edges.isPiece());
}

TEST(OutlineEdges, WhatIsNotMatchedIsNotSeenToGoOn) {
  StereoResult stereo = wall();
  const cv::Mat mask = maskOf(BOX);
  stereo.disparity.setTo(std::numeric_limits<float>::quiet_NaN(), mask == 0);
  EXPECT_EQ(outlineEdges(stereo, mask).goes_on, 0.0);
  EXPECT_FALSE(outlineEdges(stereo, mask).isPiece());
  EXPECT_FALSE(outlineEdges(stereo, cv::Mat()).isPiece());
  EXPECT_FALSE(outlineEdges({}, mask).isPiece());
}
