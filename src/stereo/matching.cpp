// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/matching.h"

#include "stereo/wls/wls_filter.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_sq::detail {
namespace {

constexpr float NAN_F = std::numeric_limits<float>::quiet_NaN();

cv::Ptr<cv::StereoMatcher>
makeMatcher(const StereoOptions& options, const DisparityRange& range, int width) {
  const int block = options.blockSizeFor(width);
  cv::Ptr<cv::StereoMatcher> matcher;
  if (options.matcher == StereoMatcher::BM) {
    auto bm = cv::StereoBM::create(range.count, std::max(5, block));
    bm->setTextureThreshold(options.texture_threshold);
    bm->setUniquenessRatio(options.uniqueness);
    matcher = bm;
  } else {
    // penalties of OpenCV's own documentation, for one grey channel
    matcher = cv::StereoSGBM::create(range.low,
                                     range.count,
                                     block,
                                     8 * block * block,
                                     32 * block * block,
                                     options.left_right_tolerance,
                                     31,
                                     options.uniqueness,
                                     0,
                                     0,
                                     cv::StereoSGBM::MODE_SGBM_3WAY);
  }
  matcher->setMinDisparity(range.low);
  matcher->setDisp12MaxDiff(options.left_right_tolerance);
  matcher->setSpeckleWindowSize(options.speckle_window);
  matcher->setSpeckleRange(options.speckle_range);
  return matcher;
}

/** \brief Sixteenths to pixels; missing ones and those whose match would lie outside of
 * the right image become NaN. */
cv::Mat toPixels(const cv::Mat& fixed, const DisparityRange& range) {
  cv::Mat result(fixed.size(), CV_32F);
  for (int v = 0; v < fixed.rows; ++v) {
    const auto* in = fixed.ptr<std::int16_t>(v);
    auto* out = result.ptr<float>(v);
    for (int u = 0; u < fixed.cols; ++u) {
      const float d = static_cast<float>(in[u]) / 16.0f;
      const float match = static_cast<float>(u) - d;
      const bool valid = d >= static_cast<float>(range.low) && match >= 0.0f &&
                         match <= static_cast<float>(fixed.cols - 1);
      out[u] = valid ? d : NAN_F;
    }
  }
  return result;
}

cv::Mat widened(const cv::Mat& image, int left, int right) {
  cv::Mat result;
  cv::copyMakeBorder(image, result, 0, 0, left, right, cv::BORDER_REPLICATE);
  return result;
}

} // namespace

DisparityRange rangeOf(double low, double high) {
  DisparityRange range;
  range.low = static_cast<int>(std::floor(low));
  const int needed = static_cast<int>(std::ceil(high)) - range.low + 1;
  range.count = std::max(16, (needed + 15) / 16 * 16);
  return range;
}

cv::Mat matchPair(const cv::Mat& left,
                  const cv::Mat& right,
                  const cv::Mat& guide,
                  const DisparityRange& range,
                  const StereoOptions& options) {
  cv::Ptr<cv::StereoMatcher> matcher = makeMatcher(options, range, left.cols);
  // OpenCV leaves out the columns for which not all of the range is in sight; with
  // widened images only those are lost whose match really lies outside
  const int pad_left = std::max(0, range.low + range.count);
  const int pad_right = std::max(0, -range.low);
  const cv::Mat wide_left = widened(left, pad_left, pad_right);
  const cv::Mat wide_right = widened(right, pad_left, pad_right);
  const cv::Rect inner(pad_left, 0, left.cols, left.rows);
  cv::Mat fixed, confidence;
  if (options.wls && wlsFilter() != nullptr) {
    wlsFilter()(wide_left,
                wide_right,
                widened(guide, pad_left, pad_right),
                matcher,
                options,
                fixed,
                confidence);
    confidence = confidence(inner);
  }
  if (fixed.empty())
    matcher->compute(wide_left, wide_right, fixed);
  cv::Mat disparity = toPixels(fixed(inner), range);
  if (!confidence.empty())
    disparity.setTo(NAN_F, confidence < options.wls_confidence);
  return disparity;
}

DisparityRange
findRange(const cv::Mat& left, const cv::Mat& right, const DisparityRange& limits) {
  const int factor = std::max(1, left.cols / 256);
  const cv::Size size(left.cols / factor, left.rows / factor);
  cv::Mat small_left, small_right;
  cv::resize(left, small_left, size, 0, 0, cv::INTER_AREA);
  cv::resize(right, small_right, size, 0, 0, cv::INTER_AREA);
  StereoOptions options;
  options.block_size = 9;
  options.speckle_window = 20;
  options.speckle_range = 1;
  const double low = static_cast<double>(limits.low) / factor;
  const double high = static_cast<double>(limits.low + limits.count) / factor;
  const DisparityRange range = rangeOf(low, high);
  const cv::Mat d = matchPair(small_left, small_right, small_left, range, options);
  std::vector<int> histogram(static_cast<std::size_t>(range.count) + 1, 0);
  for (int v = 0; v < d.rows; ++v)
    for (int u = 0; u < d.cols; ++u)
      if (const float x = d.at<float>(v, u); !std::isnan(x))
        ++histogram[static_cast<std::size_t>(
            std::clamp<long>(std::lround(x) - range.low, 0, range.count))];
  // A bin with fewer pixels than a finger-sized object has is noise.
  const int least =
      std::max(4, static_cast<int>(0.0004 * static_cast<double>(d.total())));
  const auto enough = [least](int n) { return n >= least; };
  const auto first = std::find_if(histogram.begin(), histogram.end(), enough);
  const auto last = std::find_if(histogram.rbegin(), histogram.rend(), enough);
  if (first == histogram.end())
    return {};
  const auto begin = std::distance(histogram.begin(), first);
  const auto end = static_cast<std::ptrdiff_t>(histogram.size()) -
                   std::distance(histogram.rbegin(), last);
  const auto margin = 1 + (end - begin) / 8;
  return rangeOf(std::max<double>(limits.low, factor * (range.low + begin - margin)),
                 std::min<double>(limits.low + limits.count - 1,
                                  factor * (range.low + end + margin)));
}

OrderVotes voteOnOrder(const cv::Mat& left, const cv::Mat& right) {
  const int factor = std::max(1, left.cols / 256);
  const cv::Size size(left.cols / factor, left.rows / factor);
  cv::Mat a, b;
  cv::resize(toGrey(left), a, size, 0, 0, cv::INTER_AREA);
  cv::resize(toGrey(right), b, size, 0, 0, cv::INTER_AREA);
  StereoOptions options;
  options.block_size = 9;
  options.speckle_window = 50;
  options.speckle_range = 1;
  options.uniqueness = 15;
  // disparities near zero are matches in both orders and say nothing
  const DisparityRange range = rangeOf(2.0, size.width / 3.0);
  const auto share = [&](const cv::Mat& l, const cv::Mat& r) {
    const cv::Mat d = matchPair(l, r, l, range, options);
    return static_cast<double>(cv::countNonZero(d > -FLT_MAX)) /
           static_cast<double>(d.total());
  };
  OrderVotes votes;
  votes.given = share(a, b);
  votes.exchanged = share(b, a);
  return votes;
}

cv::Mat toGrey(const cv::Mat& image) {
  if (image.channels() == 1)
    return image;
  cv::Mat grey;
  cv::cvtColor(
      image, grey, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

} // namespace pcl_sq::detail
