// SPDX-License-Identifier: BSD-3-Clause
// Pairs one after the other: what is kept from frame to frame, and what is not.
#include "pcl_sq/stereo/stereo_pipeline.h"
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

StereoPipeline pipelineFor(const StereoScene& s) {
  StereoPipeline pipeline(StereoCalibration::fromRectified(s.intrinsics));
  StereoPipelineOptions options;
  options.hint.box = s.roi;
  pipeline.setOptions(options);
  return pipeline;
}

/** \brief The image a moment later: all of it moved by whole pixels. */
cv::Mat moved(const cv::Mat& image, int x, int y) {
  cv::Mat result;
  const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, x, 0, 1, y);
  cv::warpAffine(
      image, result, shift, image.size(), cv::INTER_NEAREST, cv::BORDER_REFLECT);
  return result;
}

double sharedPart(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) / double(cv::countNonZero(a | b));
}

const Eigen::Vector3d& centerOf(const StereoObject& object) {
  return object.model.parts.front().center;
}

} // namespace

TEST(StereoPipeline, GivesTheSameModelForTheSamePairWhereFramesDoNotFollow) {
  const StereoScene s = renderScene("can");
  StereoPipeline pipeline = pipelineFor(s);
  StereoObject first, second;
  ASSERT_TRUE(pipeline.process(s.left, s.right, first)) << first.failure;
  ASSERT_TRUE(pipeline.process(s.left, s.right, second)) << second.failure;
  ASSERT_EQ(first.model.size(), second.model.size());
  EXPECT_EQ(centerOf(first), centerOf(second));
  EXPECT_TRUE(second.view.stereo.window.empty());
}

TEST(StereoPipeline, LooksOnlyAroundTheLastOutlineWhereFramesFollow) {
  const StereoScene s = renderScene("can");
  StereoPipeline pipeline = pipelineFor(s);
  pipeline.setFollowing(true);
  StereoObject first, second;
  ASSERT_TRUE(pipeline.process(s.left, s.right, first)) << first.failure;
  ASSERT_TRUE(pipeline.process(s.left, s.right, second)) << second.failure;
  const CellRect& window = second.view.stereo.window;
  ASSERT_FALSE(window.empty());
  EXPECT_LT(window.width * window.height, s.left.total());
  EXPECT_EQ(window.width, second.view.stereo.left.cols);
  const cv::Rect there(window.x, window.y, window.width, window.height);
  EXPECT_GT(sharedPart(second.view.segment.mask, first.view.segment.mask(there)), 0.95);
  const double size = s.object.box().sizes().norm();
  EXPECT_LT((centerOf(second) - centerOf(first)).norm(), 0.03 * size);
}

TEST(StereoPipeline, TheInsideOfABowlBelongsToItThoughItsRimHidesWhatIsBetween) {
  const StereoScene s = renderScene("bowl", 1.0, 1, 2);
  StereoPipeline pipeline = pipelineFor(s);
  StereoObject bowl;
  ASSERT_TRUE(pipeline.process(s.left, s.right, bowl)) << bowl.failure;
  ASSERT_EQ(bowl.model.size(), 1U);
  const Superquadric& body = bowl.model.parts.front();
  EXPECT_TRUE(body.isHollow());
  const double width = s.object.box().sizes().x();
  EXPECT_NEAR(body.boundingBox().sizes().x(), width, 0.05 * width);
}

TEST(StereoPipeline, FollowsAnObjectThatMoves) {
  const StereoScene s = renderScene("can");
  StereoPipeline pipeline = pipelineFor(s);
  pipeline.setFollowing(true);
  StereoObject first, next;
  ASSERT_TRUE(pipeline.process(s.left, s.right, first)) << first.failure;
  for (int frame = 1; frame <= 3; ++frame) {
    const int x = 6 * frame, y = -3 * frame;
    ASSERT_TRUE(pipeline.process(moved(s.left, x, y), moved(s.right, x, y), next))
        << next.failure;
    const CellRect& window = next.view.stereo.window;
    ASSERT_FALSE(window.empty());
    cv::Mat whole = cv::Mat::zeros(s.left.size(), CV_8U);
    next.view.segment.mask.copyTo(
        whole(cv::Rect(window.x, window.y, window.width, window.height)));
    EXPECT_GT(sharedPart(whole, moved(first.view.segment.mask, x, y)), 0.93);
  }
}

TEST(StereoPipeline, LooksAnewWhereTheSceneIsAnotherOne) {
  const StereoScene s = renderScene("can");
  const StereoScene other = renderScene("book");
  StereoPipeline pipeline(StereoCalibration::fromRectified(s.intrinsics));
  pipeline.setOptions({}); // the thing on the table
  pipeline.setFollowing(true);
  StereoObject object;
  ASSERT_TRUE(pipeline.process(s.left, s.right, object)) << object.failure;
  ASSERT_TRUE(pipeline.process(other.left, other.right, object)) << object.failure;
  EXPECT_TRUE(object.view.stereo.window.empty());
  EXPECT_GT(sharedPart(object.view.segment.mask, other.mask), 0.8);
}

TEST(StereoPipeline, LooksAnewWhereTheThingHasOtherColours) {
  const StereoScene s = renderScene("can");
  StereoPipeline pipeline = pipelineFor(s);
  pipeline.setFollowing(true);
  StereoObject first, next;
  ASSERT_TRUE(pipeline.process(s.left, s.right, first)) << first.failure;
  for (const std::uint64_t seed : {2, 3, 4, 5}) {
    const StereoScene other = renderScene("can", 1.0, seed);
    ASSERT_TRUE(pipeline.process(other.left, other.right, next)) << next.failure;
    EXPECT_LT((centerOf(next) - centerOf(first)).norm(), 0.005) << seed;
  }
}

TEST(StereoPipeline, SaysWhyThereIsNoModelAndGoesOn) {
  const StereoScene s = renderScene("can");
  StereoPipeline pipeline = pipelineFor(s);
  pipeline.setFollowing(true);
  StereoObject object;
  EXPECT_TRUE(pipeline.process(s.left, s.right, object)) << object.failure;
  const cv::Mat nothing(s.left.size(), CV_8UC3, cv::Scalar::all(128));
  EXPECT_FALSE(pipeline.process(nothing, nothing, object));
  EXPECT_FALSE(object.failure.empty());
  EXPECT_TRUE(object.model.parts.empty());
  EXPECT_FALSE(pipeline.process(s.left, nothing(cv::Rect(0, 0, 99, 99)), object));
  EXPECT_TRUE(pipeline.process(s.left, s.right, object)) << object.failure;
}

TEST(StereoReprojector, MatchesAWindowAsTheWholePair) {
  const StereoScene s = renderScene("can");
  StereoReprojector reprojector(StereoCalibration::fromRectified(s.intrinsics));
  const double depth = s.object.distance;
  StereoOptions options;
  options.matcher = StereoMatcher::SGBM;
  options.min_depth = 0.6 * depth;
  options.max_depth = 2.0 * depth;
  reprojector.setOptions(options);
  const StereoResult whole = reprojector.compute(s.left, s.right);
  const StereoResult part = reprojector.compute(
      s.left, s.right, {{100, 60, 140, 120}, 0.6 * depth, 2.0 * depth});
  ASSERT_EQ(part.window, (CellRect{100, 60, 140, 120}));
  int alike = 0, both = 0;
  for (int v = 10; v < 110; ++v)
    for (int u = 10; u < 130; ++u) {
      const auto& p = part.cloud->at(u, v);
      const auto& q = whole.cloud->at(u + 100, v + 60);
      if (!std::isfinite(p.z) || !std::isfinite(q.z))
        continue;
      ++both;
      alike += (p.getVector3fMap() - q.getVector3fMap()).norm() < 0.003F * q.z;
    }
  EXPECT_GT(both, 8000);
  EXPECT_GT(alike, 0.9 * both); // semi-global costs come from all around
  EXPECT_THROW(reprojector.compute(s.left, s.right, {{900, 60, 140, 120}, 0.5, 2.0}),
               Exception);
}

TEST(StereoPipeline, AModelFarFromItsPointsIsNoneWhateverTheHint) {
  EstimationReport report;
  report.confidence = 1.0;
  report.rms_distance = 0.005;
  EXPECT_EQ(doubtAbout({}, report, true), "");
  report.rms_distance = 0.04;
  EXPECT_NE(doubtAbout({}, report, true).find("40 mm off"), std::string::npos);
  EXPECT_NE(doubtAbout({}, report, false).find("40 mm off"), std::string::npos);
}
