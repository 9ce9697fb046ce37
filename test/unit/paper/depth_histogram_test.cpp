// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/depth_histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

using namespace pcl_sq;

namespace {

constexpr double SCALE = 97.4; // 811.6 px times 0.12 m

/** Depths in the middle of bins of one pixel of disparity. */
std::vector<float> depthsOf(std::initializer_list<std::pair<int, int>> bins) {
  std::vector<float> depths;
  for (const auto& [disparity, count] : bins)
    depths.insert(depths.end(),
                  static_cast<std::size_t>(count),
                  static_cast<float>(SCALE / (disparity + 0.5)));
  return depths;
}

DepthHistogram histogramOf(const std::vector<float>& depths,
                           DepthHistogramOptions options = {},
                           std::size_t pixels = 1000) {
  options.disparity_scale = SCALE;
  DepthHistogram histogram;
  std::string why;
  EXPECT_TRUE(computeDepthHistogram(depths, pixels, options, histogram, &why)) << why;
  return histogram;
}

} // namespace

TEST(DepthHistogram, CountsPixelsOfDisparity) {
  const DepthHistogram histogram = histogramOf(depthsOf({{80, 10}, {85, 20}, {2, 5}}));
  ASSERT_EQ(histogram.counts.size(), 86u);
  EXPECT_EQ(histogram.counts[80], 10u);
  EXPECT_EQ(histogram.counts[85], 20u);
  EXPECT_EQ(histogram.counts[2], 5u);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0u), 35u);
}

TEST(DepthHistogram, ApertureIsTheConnectedClusterWithTheMostPoints) {
  // the highest bin is not in it
  const DepthHistogram histogram = histogramOf(
      depthsOf({{40, 60}, {80, 30}, {81, 30}, {82, 30}, {83, 4}, {90, 50}}));
  EXPECT_EQ(histogram.first_bin, 80);
  EXPECT_EQ(histogram.last_bin, 83);
  EXPECT_NEAR(histogram.nearDepth(), SCALE / 84, 1e-9);
  EXPECT_NEAR(histogram.farDepth(), SCALE / 80, 1e-9);
  EXPECT_NEAR(histogram.median_depth, SCALE / 81.5, 1e-4);
}

TEST(DepthHistogram, BridgesGapsOfOneBinButNotOfTwo) {
  const std::vector<float> depths =
      depthsOf({{50, 20}, {51, 20}, {53, 20}, {56, 10}, {57, 10}});
  EXPECT_EQ(histogramOf(depths).first_bin, 50);
  EXPECT_EQ(histogramOf(depths).last_bin, 53);
  DepthHistogramOptions options;
  options.max_gap = 0;
  EXPECT_EQ(histogramOf(depths, options).last_bin, 51);
  options.max_gap = 2;
  EXPECT_EQ(histogramOf(depths, options).last_bin, 57);
}

TEST(DepthHistogram, BinsAtTheThresholdAreNoise) {
  EXPECT_EQ(histogramOf(depthsOf({{50, 3}, {51, 4}, {52, 3}})).first_bin, 51);
  EXPECT_EQ(histogramOf(depthsOf({{50, 3}, {51, 4}, {52, 3}})).last_bin, 51);
  // 0.3 % of 10000 pixels
  EXPECT_EQ(histogramOf(depthsOf({{50, 30}, {51, 31}, {52, 30}}), {}, 10000).last_bin,
            51);
}

TEST(DepthHistogram, TheBinAtInfinityIsNeverInTheAperture) {
  EXPECT_EQ(histogramOf(depthsOf({{0, 500}, {1, 10}, {2, 10}})).first_bin, 1);
  DepthHistogram histogram;
  DepthHistogramOptions options;
  options.disparity_scale = SCALE;
  EXPECT_FALSE(computeDepthHistogram(depthsOf({{0, 500}}), 1000, options, histogram));
}

TEST(DepthHistogram, ContainsExactlyTheDepthsOfItsBins) {
  const DepthHistogram histogram = histogramOf(depthsOf({{80, 30}, {81, 30}}));
  EXPECT_TRUE(histogram.contains(histogram.nearDepth() * 1.0001));
  EXPECT_FALSE(histogram.contains(histogram.nearDepth() * 0.9999));
  EXPECT_TRUE(histogram.contains(histogram.farDepth() * 0.9999));
  EXPECT_FALSE(histogram.contains(histogram.farDepth() * 1.0001));
  for (const double bad : {0.0, -1.0, 1e-30, 1e300, HUGE_VAL, std::nan("")})
    EXPECT_FALSE(histogram.contains(bad)) << bad;
}

TEST(DepthHistogram, WithoutACameraBinsAreRelativeToTheScene) {
  for (const float scale : {0.1f, 1.0f, 20.0f}) {
    std::vector<float> depths;
    for (int i = 0; i <= 100; ++i) // an object of a tenth of its distance
      depths.insert(depths.end(), 5, scale * (1.0f + 0.001f * static_cast<float>(i)));
    depths.insert(depths.end(), 100, scale * 1.5f); // a wall
    DepthHistogram histogram;
    ASSERT_TRUE(computeDepthHistogram(depths, depths.size(), {}, histogram));
    EXPECT_NEAR(histogram.nearDepth(), scale, 0.015 * scale);
    EXPECT_NEAR(histogram.farDepth(), 1.1 * scale, 0.015 * scale);
  }
}

TEST(DepthHistogram, SkipsWhatIsNoDepth) {
  std::vector<float> depths = depthsOf({{60, 50}});
  for (const float bad : {0.0f, -1.0f, NAN, INFINITY, -INFINITY, 1e-30f})
    depths.insert(depths.end(), 100, bad);
  const DepthHistogram histogram = histogramOf(depths);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0u), 50u);
  EXPECT_LE(histogram.counts.size(), 4096u);
}

TEST(DepthHistogram, FailsWithASentenceIfThereIsNoCluster) {
  DepthHistogram histogram;
  for (const std::vector<float>& depths : {std::vector<float>(),
                                           std::vector<float>{NAN, -1.0f},
                                           std::vector<float>{1.0f}}) {
    std::string why;
    EXPECT_FALSE(computeDepthHistogram(depths, 100, {}, histogram, &why));
    EXPECT_FALSE(why.empty());
    EXPECT_LT(histogram.last_bin, histogram.first_bin);
    EXPECT_FALSE(histogram.contains(1.0));
  }
}

TEST(DepthHistogramOptions, RangesAreCheckedAtBothEnds) {
  EXPECT_TRUE(DepthHistogramOptions().isValid());
  const auto isValidWith = [](auto change) {
    DepthHistogramOptions changed;
    change(changed);
    std::string why;
    const bool valid = changed.isValid(&why);
    EXPECT_NE(valid, !why.empty());
    return valid;
  };
  using Options = DepthHistogramOptions;
  EXPECT_FALSE(isValidWith([](Options& o) { o.disparity_scale = -1.0; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.disparity_scale = HUGE_VAL; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.relative_bin = 0.0; }));
  EXPECT_TRUE(isValidWith([](Options& o) { o.relative_bin = 1.0; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.relative_bin = 1.1; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.min_count = -1; }));
  EXPECT_TRUE(isValidWith([](Options& o) { o.min_share = 1.0; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.min_share = 1.1; }));
  EXPECT_FALSE(isValidWith([](Options& o) { o.max_gap = -1; }));
}
