// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const StereoScene& box() {
  static const StereoScene scene = renderScene("box");
  return scene;
}

StereoResult compute(const StereoScene& s, const StereoOptions& options = {}) {
  StereoReprojector reprojector(StereoCalibration::fromRectified(s.intrinsics));
  reprojector.setOptions(options);
  return reprojector.compute(s.left, s.right);
}

std::string refusal(const cv::Mat& left, const cv::Mat& right) {
  StereoReprojector reprojector(StereoCalibration::fromRectified(box().intrinsics));
  try {
    (void)reprojector.compute(left, right);
  } catch (const Exception& e) {
    return e.what();
  }
  return "";
}

} // namespace

TEST(ReprojectDisparity, InvertsTheProjectionOfARandomCloud) {
  StereoIntrinsics k;
  k.fx = 700.0;
  k.fy = 710.0;
  k.cx = 13.5;
  k.cy = 9.25;
  k.baseline = 0.1;
  k.doffs = 5.5;
  cv::Mat disparity(20, 30, CV_32F);
  cv::RNG random(3);
  random.fill(disparity, cv::RNG::UNIFORM, 5.0, 120.0);
  const auto cloud = reprojectDisparity(disparity, cv::Mat(), k);
  ASSERT_TRUE(cloud->isOrganized());
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 30; ++u) {
      const Eigen::Vector3d p = cloud->at(u, v).getVector3fMap().cast<double>();
      const Eigen::Vector2d pixel = k.project(p);
      EXPECT_NEAR(pixel.x(), u, 1e-3);
      EXPECT_NEAR(pixel.y(), v, 1e-3);
      EXPECT_NEAR(k.disparity(p.z()), disparity.at<float>(v, u), 1e-3);
    }
}

TEST(ReprojectDisparity, MissingPixelsAreNanAndTheSizeStays) {
  cv::Mat disparity(4, 5, CV_32F, cv::Scalar(10));
  disparity.at<float>(1, 2) = std::nanf("");
  disparity.at<float>(0, 0) = std::numeric_limits<float>::infinity();
  disparity.at<float>(3, 4) = 0.0f; // infinitely far
  disparity.at<float>(2, 2) = -3.0f;
  const auto cloud = reprojectDisparity(disparity, cv::Mat(), box().intrinsics);
  EXPECT_EQ(cloud->width, 5u);
  EXPECT_EQ(cloud->height, 4u);
  EXPECT_FALSE(cloud->is_dense);
  int missing = 0;
  for (const auto& p : *cloud)
    missing += std::isnan(p.x) && std::isnan(p.y) && std::isnan(p.z) ? 1 : 0;
  EXPECT_EQ(missing, 4);
}

TEST(ReprojectDepth, AgreesWithTheStereoDoor) {
  const StereoScene& s = box();
  cv::Mat depth(s.disparity.size(), CV_16U);
  for (int i = 0; i < static_cast<int>(depth.total()); ++i)
    depth.ptr<std::uint16_t>()[i] = static_cast<std::uint16_t>(
        std::lround(1e4 * s.intrinsics.depth(s.disparity.ptr<float>()[i])));
  depth.at<std::uint16_t>(0, 0) = 0;
  const StereoResult result = reprojectDepth(depth, 1e-4, s.intrinsics, s.left);
  const auto exact = reprojectDisparity(s.disparity, s.left, s.intrinsics);
  EXPECT_TRUE(std::isnan(result.cloud->at(0, 0).z));
  for (std::size_t i = 1; i < exact->size(); ++i)
    ASSERT_NEAR((*result.cloud)[i].z, (*exact)[i].z, 1e-4);
  EXPECT_EQ((*result.cloud)[500].r, (*exact)[500].r);
  EXPECT_THROW((void)reprojectDepth(depth, 0.0, s.intrinsics), Exception);
  EXPECT_THROW((void)reprojectDepth(cv::Mat(), 1.0, s.intrinsics), Exception);
}

class StereoReprojectorMatchers : public ::testing::TestWithParam<StereoMatcher> {};

TEST_P(StereoReprojectorMatchers, FindsTheDisparitiesOfARenderedObject) {
  StereoOptions options;
  options.matcher = GetParam();
  const StereoResult result = compute(box(), options);
  const DisparityError error =
      compareDisparity(result.disparity, box().disparity, box().mask);
  EXPECT_LT(error.median, 0.2);
  EXPECT_GT(error.coverage, 0.8);
  EXPECT_EQ(result.cloud->width, 320u);
  EXPECT_FALSE(result.cloud->is_dense);
}

TEST_P(StereoReprojectorMatchers, AGivenDepthRangeLeavesOutTheRest) {
  StereoOptions options;
  options.matcher = GetParam();
  options.min_depth = 0.8;
  options.max_depth = 1.3;
  const StereoResult result = compute(box(), options);
  for (const auto& p : *result.cloud)
    if (std::isfinite(p.z)) {
      ASSERT_LT(p.z, 3.0f); // whole blocks of sixteen disparities are searched
    }
  EXPECT_GT(compareDisparity(result.disparity, box().disparity, box().mask).coverage,
            0.8);
}

INSTANTIATE_TEST_SUITE_P(Matchers,
                         StereoReprojectorMatchers,
                         ::testing::Values(StereoMatcher::BM, StereoMatcher::SGBM));

TEST(StereoReprojector, SaysWhenLeftAndRightAreExchanged) {
  EXPECT_NE(refusal(box().right, box().left).find("exchange left and right"),
            std::string::npos);
  EXPECT_FALSE(imagesSeemSwapped(box().left, box().right));
  EXPECT_TRUE(imagesSeemSwapped(box().right, box().left));
}

TEST(StereoReprojector, SaysWhenThereIsNoTexture) {
  const cv::Mat flat(240, 320, CV_8UC3, cv::Scalar::all(127));
  EXPECT_NE(refusal(flat, flat).find("no texture"), std::string::npos);
}

TEST(StereoReprojector, RefusesUnsuitableImages) {
  const cv::Mat small(100, 100, CV_8UC3, cv::Scalar::all(0));
  EXPECT_NE(refusal(box().left, small).find("one size"), std::string::npos);
  EXPECT_NE(refusal(small, small).find("calibration is for"), std::string::npos);
  EXPECT_NE(refusal(box().left, cv::Mat()).find("empty"), std::string::npos);
  EXPECT_NE(refusal(cv::Mat(240, 320, CV_32F), box().right).find("8-bit"),
            std::string::npos);
}

TEST(StereoOptions, RangesAreCheckedAndInvalidOptionsRefused) {
  StereoOptions o;
  EXPECT_TRUE(o.isValid());
  std::string why;
  o.block_size = 4;
  EXPECT_FALSE(o.isValid(&why));
  EXPECT_FALSE(why.empty());
  StereoReprojector reprojector;
  reprojector.setOptions(o);
  EXPECT_EQ(reprojector.getOptions().block_size, 0);
  o = {};
  o.min_depth = 2.0;
  o.max_depth = 1.0;
  EXPECT_FALSE(o.isValid());
  o = {};
  o.uniqueness = 101;
  EXPECT_FALSE(o.isValid());
}
