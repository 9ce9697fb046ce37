// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_scene.h"

#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <functional>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

constexpr int LINE = 320, LINES = 240;

struct Pair {
  cv::Mat left, right, truth;
};

/** \brief A textured pair with disparities that are known for the left image: both
 * images sample one texture that is much finer than their pixels along the rows. */
Pair makePair(const std::function<double(double, double)>& disparity,
              double contrast = 30.0) {
  constexpr int FINE = 16, MARGIN = 64;
  cv::RNG random(7);
  cv::Mat texture(LINES, FINE * (LINE + 2 * MARGIN), CV_32F);
  random.fill(texture, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(texture, texture, {0, 0}, 1.2 * FINE, 1.2);
  cv::Scalar mean, deviation;
  cv::meanStdDev(texture, mean, deviation);
  texture = 128.0 + (contrast / deviation[0]) * texture;
  const auto sample = [&texture](double u, int v) {
    return texture.at<float>(v, static_cast<int>(std::lround(FINE * (u + MARGIN))));
  };
  Pair pair;
  pair.truth.create(LINES, LINE, CV_32F);
  cv::Mat left(LINES, LINE, CV_32F), right(LINES, LINE, CV_32F);
  for (int v = 0; v < LINES; ++v)
    for (int u = 0; u < LINE; ++u) {
      const double d = disparity(u, v);
      pair.truth.at<float>(v, u) = static_cast<float>(d);
      left.at<float>(v, u) = sample(u - d, v) + float(random.gaussian(2.0));
      right.at<float>(v, u) = sample(u, v) + float(random.gaussian(2.0));
    }
  left.convertTo(pair.left, CV_8U);
  right.convertTo(pair.right, CV_8U);
  return pair;
}

cv::Mat disparityOf(const Pair& pair, bool refine, StereoMatcher matcher) {
  StereoOptions options;
  options.matcher = matcher;
  options.refine = refine;
  StereoIntrinsics k;
  k.fx = k.fy = 400.0;
  k.cx = LINE / 2;
  k.cy = LINES / 2;
  k.width = LINE;
  k.height = LINES;
  k.baseline = 0.1;
  StereoReprojector reprojector(StereoCalibration::fromRectified(k));
  reprojector.setOptions(options);
  return reprojector.compute(pair.left, pair.right).disparity;
}

/** \brief Median error, away from the image's border. */
double medianError(const cv::Mat& disparity, const cv::Mat& truth) {
  const cv::Mat inner(disparity.size(), CV_8U, cv::Scalar(0));
  inner(cv::Rect(40, 10, LINE - 60, LINES - 20)).setTo(255);
  return compareDisparity(disparity, truth, inner).median;
}

double slant(double u, double v) {
  return 20.0 + 0.15 * (u - 160.0) / 2.0 - 0.06 * (v - 120.0);
}

class Refine : public testing::TestWithParam<StereoMatcher> {};

} // namespace

TEST_P(Refine, HalvesTheErrorOnASlantedPlane) {
  const Pair pair = makePair(slant);
  const double before = medianError(disparityOf(pair, false, GetParam()), pair.truth);
  const double after = medianError(disparityOf(pair, true, GetParam()), pair.truth);
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LT(after, 0.04);
}

TEST_P(Refine, LeansLessTowardsWholePixelsThanTheMatcher) {
  double before = 0.0, after = 0.0; // largest mean error
  for (const double fraction : {0.125, 0.25, 0.375, 0.625, 0.75, 0.875}) {
    const Pair pair = makePair([=](double, double) { return 16.0 + fraction; });
    const auto lean = [&pair](bool refine) {
      const cv::Mat error = disparityOf(pair, refine, GetParam()) - pair.truth;
      return std::abs(cv::mean(error, error == error)[0]);
    };
    before = std::max(before, lean(false));
    after = std::max(after, lean(true));
  }
  EXPECT_LT(after, before);
  EXPECT_LT(after, 0.03); // interpolated noise is smallest halfway, and draws there
}

TEST_P(Refine, ExposureOfOneCameraDoesNotMatter) {
  Pair pair = makePair(slant);
  const double same = medianError(disparityOf(pair, true, GetParam()), pair.truth);
  cv::Mat ramp(LINES, LINE, CV_32F); // an offset, and vignetting
  for (int v = 0; v < LINES; ++v)
    for (int u = 0; u < LINE; ++u)
      ramp.at<float>(v, u) = 12.0F + 0.05F * float(u);
  cv::Mat brighter;
  pair.right.convertTo(brighter, CV_32F);
  brighter += ramp;
  brighter.convertTo(pair.right, CV_8U);
  EXPECT_NEAR(medianError(disparityOf(pair, true, GetParam()), pair.truth), same, 0.02);
}

TEST_P(Refine, KeepsTheStepBetweenTwoSurfaces) {
  const Pair pair = makePair([](double u, double) { return u < 160.0 ? 14.0 : 20.0; });
  const cv::Mat d = disparityOf(pair, true, GetParam());
  for (int v = 20; v < LINES - 20; ++v)
    for (int u = 50; u < LINE - 30; ++u) {
      const float x = d.at<float>(v, u);
      if (!std::isnan(x) && std::abs(u - 160) > 12) {
        ASSERT_NEAR(x, pair.truth.at<float>(v, u), 0.75) << u << ' ' << v;
      }
    }
}

TEST_P(Refine, WeakTextureIsLeftToTheMatcher) {
  const Pair pair = makePair(slant, 4.0);
  const double before = medianError(disparityOf(pair, false, GetParam()), pair.truth);
  EXPECT_LT(medianError(disparityOf(pair, true, GetParam()), pair.truth), before);
}

TEST_P(Refine, ResultIsTheSameForAnyNumberOfThreads) {
  const Pair pair = makePair(slant);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const cv::Mat one = disparityOf(pair, true, GetParam());
  cv::setNumThreads(4);
  const cv::Mat four = disparityOf(pair, true, GetParam());
  cv::setNumThreads(threads);
  for (int v = 0; v < LINES; ++v)
    for (int u = 0; u < LINE; ++u) {
      const float a = one.at<float>(v, u), b = four.at<float>(v, u);
      ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << u << ' ' << v;
    }
}

INSTANTIATE_TEST_SUITE_P(Matchers,
                         Refine,
                         testing::Values(StereoMatcher::BM, StereoMatcher::SGBM),
                         [](const auto& matcher) {
                           return matcher.param == StereoMatcher::BM ? "BlockMatching"
                                                                     : "SemiGlobal";
                         });
