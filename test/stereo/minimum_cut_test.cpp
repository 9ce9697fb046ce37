// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/minimum_cut.h"

#include <gtest/gtest.h>

using namespace pcl_sq::detail;

namespace {

/** \brief What a labelling costs, 255 = object. */
double costOf(const cv::Mat& mask, const cv::Mat& odds, const Borders& borders) {
  const cv::Rect all({}, mask.size());
  double cost = 0.0;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x) {
      const auto o = double(odds.at<float>(y, x));
      const auto label = mask.at<std::uint8_t>(y, x);
      cost += std::max(0.0, label != 0 ? -o : o);
      for (const cv::Point& d : {cv::Point(1, 0), {0, 1}, {1, 1}, {-1, 1}}) {
        const cv::Point here(x, y), there = here + d;
        if (all.contains(there) && mask.at<std::uint8_t>(there) != label)
          cost += borders.cost(here, there);
      }
    }
  return cost;
}

} // namespace

TEST(MinimumCut, CostsNoMoreThanAnyLabellingOfTheOpenPixels) {
  cv::RNG random(5);
  for (int round = 0; round < 20; ++round) {
    cv::Mat image(3, 4, CV_8UC3), odds(3, 4, CV_32F);
    random.fill(image, cv::RNG::UNIFORM, 0, 60);
    random.fill(odds, cv::RNG::NORMAL, 0.0, 3.0);
    cv::Mat open(3, 4, CV_8U, cv::Scalar(255));
    open.at<std::uint8_t>(1, 2) = open.at<std::uint8_t>(0, 0) = 0;
    const Borders borders(image, 600.0, 2.0, 1e-3);
    const double cost = costOf(minimumCut(borders, odds, open), odds, borders);
    for (int labels = 0; labels < 1 << 12; ++labels) {
      cv::Mat other(3, 4, CV_8U);
      for (int i = 0; i < 12; ++i)
        other.ptr<std::uint8_t>()[i] = (labels >> i & 1) != 0 ? 255 : 0;
      cv::Mat(odds > 0.0F).copyTo(other, open == 0);
      EXPECT_LE(cost, costOf(other, odds, borders) + 1e-9);
    }
  }
}
