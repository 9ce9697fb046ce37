// SPDX-License-Identifier: BSD-3-Clause
// The noise that a pair tells of itself, against the truth.
#include "pcl_sq/stereo/stereo_reprojector.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace pcl_sq;

namespace {

constexpr int COLUMNS = 400, ROWS = 300;
constexpr double DISPARITY = 24.0;

struct Errors {
  double measured = 0.0, actual = 0.0; ///< medians of the magnitudes' size [px]
};

/** \brief A plane across the optical axis, seen with some noise of the grey values. */
Errors errorsOf(double noise) {
  cv::RNG random(3);
  cv::Mat texture(ROWS, COLUMNS + 64, CV_32F);
  random.fill(texture, cv::RNG::NORMAL, 0.0, 1.0);
  cv::GaussianBlur(texture, texture, {0, 0}, 1.5);
  cv::Scalar mean, deviation;
  cv::meanStdDev(texture, mean, deviation);
  texture = 128.0 + (25.0 / deviation[0]) * texture;
  const auto image = [&](double shift) {
    cv::Mat part(ROWS, COLUMNS, CV_32F), grain(ROWS, COLUMNS, CV_32F), result;
    texture(cv::Rect(static_cast<int>(shift), 0, COLUMNS, ROWS)).copyTo(part);
    random.fill(grain, cv::RNG::NORMAL, 0.0, noise);
    cv::Mat(part + grain).convertTo(result, CV_8U);
    return result;
  };
  StereoIntrinsics k;
  k.fx = k.fy = 400.0;
  k.cx = 0.5 * COLUMNS;
  k.cy = 0.5 * ROWS;
  k.width = COLUMNS;
  k.height = ROWS;
  k.baseline = 0.1;
  StereoReprojector reprojector(StereoCalibration::fromRectified(k));
  StereoOptions options;
  options.matcher = StereoMatcher::SGBM;
  reprojector.setOptions(options);
  const StereoResult result = reprojector.compute(image(0.0), image(DISPARITY));
  std::vector<double> measured, actual;
  for (int v = 20; v < ROWS - 20; ++v)
    for (int u = 60; u < COLUMNS - 20; ++u)
      if (const float d = result.disparity.at<float>(v, u); !std::isnan(d)) {
        measured.push_back(double(result.disparity_sigma.at<float>(v, u)));
        actual.push_back(std::abs(double(d) - DISPARITY));
      }
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.empty() ? 0.0 : *middle;
  };
  return {median(measured), 1.4826 * median(actual)};
}

} // namespace

TEST(DisparityNoise, IsWhatTheDisparitiesErrBy) {
  for (const double noise : {3.0, 8.0}) {
    const Errors errors = errorsOf(noise);
    EXPECT_GT(errors.measured, 0.5 * errors.actual) << noise;
    EXPECT_LT(errors.measured, 2.0 * errors.actual) << noise;
  }
}

TEST(DisparityNoise, GrowsWithTheGrainOfTheImages) {
  EXPECT_GT(errorsOf(8.0).measured, 1.5 * errorsOf(3.0).measured);
}
