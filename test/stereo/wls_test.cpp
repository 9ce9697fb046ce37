// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

cv::Mat disparityOf(const StereoScene& s, bool wls) {
  StereoOptions options;
  options.matcher = StereoMatcher::SGBM;
  options.wls = wls;
  StereoReprojector reprojector(StereoCalibration::fromRectified(s.intrinsics));
  reprojector.setOptions(options);
  return reprojector.compute(s.left, s.right).disparity;
}

/** \brief Share of the matched pixels of a mask that are more than a pixel off. */
double wrongShare(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask) {
  int matched = 0, wrong = 0;
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u) {
      const float d = disparity.at<float>(v, u);
      if (mask.at<std::uint8_t>(v, u) == 0 || std::isnan(d))
        continue;
      ++matched;
      wrong += std::abs(d - truth.at<float>(v, u)) > 1.0f ? 1 : 0;
    }
  return matched == 0 ? 1.0 : static_cast<double>(wrong) / matched;
}

} // namespace

TEST(StereoWls, SmoothsInsideAndMakesObjectsLessFat) {
  const StereoScene scene = renderScene("can");
  const cv::Mat plain = disparityOf(scene, false), smooth = disparityOf(scene, true);
  const DisparityError before = compareDisparity(plain, scene.disparity, scene.mask);
  const DisparityError after = compareDisparity(smooth, scene.disparity, scene.mask);
  EXPECT_LT(after.median, before.median);
  EXPECT_GT(after.coverage, 0.7); // what is not sure is left out
  cv::Mat rim;
  cv::dilate(scene.mask, rim, cv::getStructuringElement(cv::MORPH_RECT, {9, 9}));
  rim.setTo(0, scene.mask);
  EXPECT_LT(wrongShare(smooth, scene.disparity, rim),
            wrongShare(plain, scene.disparity, rim));
}
