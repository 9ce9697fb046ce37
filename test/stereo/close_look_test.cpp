// SPDX-License-Identifier: BSD-3-Clause
// Pairs of which only the object's surroundings are matched in full detail.
#include "pcl_sq/stereo/stereo_pipeline.h"
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief 640 x 480: smaller images are matched as a whole. */
const StereoScene& scene() {
  static const StereoScene result = renderScene("can", 1.0, 1, 2);
  return result;
}

StereoReprojector reprojector() {
  StereoReprojector result(StereoCalibration::fromRectified(scene().intrinsics));
  StereoOptions options;
  options.matcher = StereoMatcher::SGBM;
  result.setOptions(options);
  return result;
}

/** \brief Median distance of disparities, and the share of pixels that have both. */
struct Agreement {
  double median = 0.0, share = 0.0;
};
Agreement compare(const cv::Mat& a, const cv::Mat& b) {
  std::vector<float> off;
  for (int v = 0; v < a.rows; ++v)
    for (int u = 0; u < a.cols; ++u)
      if (const float d = a.at<float>(v, u) - b.at<float>(v, u); std::isfinite(d))
        off.push_back(std::abs(d));
  if (off.empty())
    return {};
  const auto middle = off.begin() + std::ptrdiff_t(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return {double(*middle), double(off.size()) / double(a.total())};
}

cv::Rect objectBox() {
  const CellRect box = boundingRect(scene().mask);
  return {box.x, box.y, box.width, box.height};
}

StereoObject modelOf(const StereoHint& hint) {
  StereoPipeline pipeline(StereoCalibration::fromRectified(scene().intrinsics));
  StereoPipelineOptions options;
  options.hint = hint;
  pipeline.setOptions(options);
  StereoObject object;
  EXPECT_TRUE(pipeline.process(scene().left, scene().right, object)) << object.failure;
  return object;
}

} // namespace

TEST(CloseLook, APairAtHalfItsSizeIsAsFarAwayAndSaysThatItIsCoarser) {
  StereoReprojector stereo = reprojector();
  const StereoResult coarse = stereo.computeCoarse(scene().left, scene().right);
  const StereoResult fine = stereo.compute(scene().left, scene().right);
  ASSERT_EQ(coarse.disparity.size(), scene().left.size());
  ASSERT_EQ(coarse.cloud->width, fine.cloud->width);
  const Agreement truth = compare(coarse.disparity, scene().disparity);
  EXPECT_LT(truth.median, 0.5);
  EXPECT_GT(truth.share, 0.7);
  EXPECT_GT(cv::mean(coarse.disparity_sigma)[0], cv::mean(fine.disparity_sigma)[0]);
}

TEST(CloseLook, APartInDetailIsAsTheWholePairThereAndNothingElseChanges) {
  StereoReprojector stereo = reprojector();
  const StereoResult fine = stereo.compute(scene().left, scene().right);
  const StereoResult coarse = stereo.computeCoarse(scene().left, scene().right);
  StereoResult close = coarse;
  close.disparity = coarse.disparity.clone();
  const cv::Rect part = objectBox();
  stereo.computeDetail(close, {part.x, part.y, part.width, part.height});
  const Agreement there = compare(close.disparity(part), fine.disparity(part));
  EXPECT_LT(there.median, 0.02);
  EXPECT_GT(there.share, 0.9);
  cv::Mat other(coarse.disparity.size(), CV_8U, cv::Scalar(255));
  other(part).setTo(0);
  cv::Mat changed = (close.disparity != coarse.disparity) &
                    (coarse.disparity == coarse.disparity) & other;
  EXPECT_EQ(cv::countNonZero(changed), 0);
  for (const cv::Point& at : {part.tl(), part.br() - cv::Point(1, 1)}) {
    const auto& p = close.cloud->at(at.x, at.y);
    const double d = close.disparity.at<float>(at);
    if (std::isfinite(d)) {
      EXPECT_NEAR(double(p.z), scene().intrinsics.depth(d), 1e-4);
    }
  }
}

TEST(CloseLook, ModelsAreThoseOfTheWholePairWhateverTheHint) {
  StereoHint box, mask;
  box.box = scene().roi;
  mask.mask = scene().mask;
  StereoPipeline pipeline(StereoCalibration::fromRectified(scene().intrinsics));
  const double size = scene().object.box().sizes().norm();
  for (const StereoHint& hint : {StereoHint(), box, mask}) {
    const StereoObject close = modelOf(hint);
    StereoPipelineOptions options;
    options.hint = hint;
    pipeline.setOptions(options);
    const StereoView whole =
        pipeline.look(pipeline.see(scene().left, scene().right).stereo);
    ASSERT_EQ(whole.segment.mask.size(), close.view.segment.mask.size());
    const double both = cv::countNonZero(whole.segment.mask & close.view.segment.mask);
    const double any = cv::countNonZero(whole.segment.mask | close.view.segment.mask);
    EXPECT_GT(both, 0.97 * any);
    ASSERT_FALSE(close.model.parts.empty());
    const Eigen::Vector3d truth(0.0, 0.0, scene().object.distance);
    EXPECT_LT((close.model.parts.front().center - truth).norm(), 0.05 * size);
  }
}

TEST(CloseLook, SmallImagesAndThePapersMatcherSeeTheWholePair) {
  StereoHint box;
  box.box = scene().roi;
  EXPECT_FALSE(modelOf(box).view.stereo.detail.empty());
  const StereoScene small = renderScene("can");
  StereoPipeline pipeline(StereoCalibration::fromRectified(small.intrinsics));
  StereoObject object;
  EXPECT_TRUE(pipeline.process(small.left, small.right, object)) << object.failure;
  EXPECT_TRUE(object.view.stereo.detail.empty());
  StereoPipeline paper(StereoCalibration::fromRectified(scene().intrinsics));
  StereoPipelineOptions options;
  options.stereo.matcher = StereoMatcher::BM;
  options.hint = box;
  paper.setOptions(options);
  EXPECT_TRUE(paper.process(scene().left, scene().right, object)) << object.failure;
  EXPECT_TRUE(object.view.stereo.detail.empty());
}
