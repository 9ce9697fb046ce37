// SPDX-License-Identifier: BSD-3-Clause
// Pairs of which a part is matched in full detail, the rest coarsely or not at all.
#include "pcl_sq/stereo/stereo_reprojector.h"
#include "stereo/matching.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace pcl_sq {
namespace {

constexpr int LEAST_SIDE = 32; ///< of a part, so that windows fit into it [px]

cv::Rect rectOf(const CellRect& r) {
  return {r.x, r.y, r.width, r.height};
}

/** \brief Camera of an image of half the size: a pixel holds four. */
StereoIntrinsics halved(const StereoIntrinsics& k, const cv::Size& size) {
  StereoIntrinsics half = k;
  half.fx = 0.5 * k.fx;
  half.fy = 0.5 * k.fy;
  half.cx = 0.5 * (k.cx + 0.5) - 0.5;
  half.cy = 0.5 * (k.cy + 0.5) - 0.5;
  half.doffs = 0.5 * k.doffs;
  half.width = size.width;
  half.height = size.height;
  return half;
}

/** \brief Disparities at twice the size: between neighbours of one surface, else the
 * nearest. */
cv::Mat doubled(const cv::Mat& half, const cv::Size& size) {
  constexpr float SURFACE = 1.0F; // step between neighbours of one surface [px]
  cv::Mat result(size, CV_32F);
  for (int v = 0; v < size.height; ++v) {
    const float y = std::clamp(
        0.5F * (float(v) + 0.5F) - 0.5F, 0.0F, static_cast<float>(half.rows - 1));
    const int y0 = std::min(static_cast<int>(y), half.rows - 2);
    const float fy = y - static_cast<float>(y0);
    const auto* above = half.ptr<float>(y0);
    const auto* below = half.ptr<float>(y0 + 1);
    auto* out = result.ptr<float>(v);
    for (int u = 0; u < size.width; ++u) {
      const float x = std::clamp(
          0.5F * (float(u) + 0.5F) - 0.5F, 0.0F, static_cast<float>(half.cols - 1));
      const int x0 = std::min(static_cast<int>(x), half.cols - 2);
      const float fx = x - static_cast<float>(x0);
      const float a = above[x0], b = above[x0 + 1], c = below[x0], d = below[x0 + 1];
      const float low = std::min(std::min(a, b), std::min(c, d));
      const float high = std::max(std::max(a, b), std::max(c, d));
      if (high - low < SURFACE && !std::isnan(a + b + c + d))
        out[u] = 2.0F * ((1.0F - fy) * (a + fx * (b - a)) + fy * (c + fx * (d - c)));
      else
        out[u] = 2.0F * (fy < 0.5F ? above : below)[fx < 0.5F ? x0 : x0 + 1];
    }
  }
  return result;
}

/** \brief Range of the disparities in a part, but for the few that are false.
 * \return whether there are any */
bool rangeIn(const cv::Mat& disparity, float& low, float& high) {
  constexpr double FALSE_ONES = 0.002; // on each side
  std::vector<float> values;
  for (int v = 0; v < disparity.rows; v += 2)
    for (int u = 0; u < disparity.cols; u += 2)
      if (const float d = disparity.at<float>(v, u); !std::isnan(d))
        values.push_back(d);
  if (values.empty())
    return false;
  const auto few = static_cast<std::ptrdiff_t>(FALSE_ONES * double(values.size()));
  std::nth_element(values.begin(), values.begin() + few, values.end());
  low = values[std::size_t(few)];
  std::nth_element(values.begin(), values.end() - 1 - few, values.end());
  high = *(values.end() - 1 - few);
  return true;
}

} // namespace

StereoResult StereoReprojector::compute(const cv::Mat& left,
                                        const cv::Mat& right,
                                        const StereoWindow& window) {
  const StereoResult pair = rectified(left, right);
  StereoResult result = matchWindow(pair, window);
  result.timings_ms.insert(
      result.timings_ms.begin(), pair.timings_ms.begin(), pair.timings_ms.end());
  return result;
}

StereoResult StereoReprojector::matchWindow(const StereoResult& pair,
                                            const StereoWindow& window) const {
  StereoResult result;
  result.intrinsics = pair.intrinsics;
  StereoIntrinsics& k = result.intrinsics;
  // the window of the right image is moved by the disparity of the middle depth, so
  // that both together are a pair of their own with another offset
  const auto shift = static_cast<int>(std::lround(
      0.5 * (k.disparity(window.min_depth) + k.disparity(window.max_depth))));
  const cv::Rect all(0, 0, pair.left.cols, pair.left.rows);
  const cv::Rect here = rectOf(window.rect) & all & (all + cv::Point(shift, 0));
  if (here.width < LEAST_SIDE || here.height < LEAST_SIDE)
    throw Exception("[pcl_sq::StereoReprojector::compute] the window lies outside of "
                    "the images; give one within them.");
  result.window = {here.x, here.y, here.width, here.height};
  result.left = pair.left(here).clone();
  result.right = pair.right(here - cv::Point(shift, 0)).clone();
  k.cx -= here.x;
  k.cy -= here.y;
  k.width = here.width;
  k.height = here.height;
  k.doffs += shift;
  StereoReprojector part;
  part.options_ = options_;
  part.options_.min_depth = window.min_depth;
  part.options_.max_depth = window.max_depth;
  part.options_.check_order = false;
  part.match(result);
  return result;
}

StereoResult StereoReprojector::computeCoarse(const cv::Mat& left,
                                              const cv::Mat& right) {
  StereoResult result = rectified(left, right);
  const auto start = std::chrono::steady_clock::now();
  const cv::Size size = result.left.size(),
                 even(size.width / 2 * 2, size.height / 2 * 2);
  const cv::Rect whole({}, even);
  const cv::Size half(even.width / 2, even.height / 2);
  StereoReprojector small(
      StereoCalibration::fromRectified(halved(result.intrinsics, half)));
  small.options_ = options_;
  small.options_.speckle_window = options_.speckle_window / 4;
  small.options_.speckle_range = std::max(1, options_.speckle_range / 2);
  StereoResult coarse;
  coarse.intrinsics = small.calibration_.getIntrinsics();
  cv::resize(result.left(whole), coarse.left, half, 0, 0, cv::INTER_AREA);
  cv::resize(result.right(whole), coarse.right, half, 0, 0, cv::INTER_AREA);
  try {
    small.match(coarse);
  } catch (const Exception&) {
    checkOrder(left, right);
    throw;
  }
  result.disparity = doubled(coarse.disparity, size);
  cv::resize(2.0 * coarse.disparity_sigma,
             result.disparity_sigma,
             size,
             0,
             0,
             cv::INTER_NEAREST);
  result.correlation = 2.0 * coarse.correlation;
  result.cloud = reprojectDisparity(result.disparity, result.left, result.intrinsics);
  result.coverage = coarse.coverage;
  result.timings_ms.emplace_back("overview",
                                 std::chrono::duration<double, std::milli>(
                                     std::chrono::steady_clock::now() - start)
                                     .count());
  return result;
}

void StereoReprojector::computeDetail(StereoResult& scene, const CellRect& part) const {
  const cv::Rect all(0, 0, scene.disparity.cols, scene.disparity.rows);
  const cv::Rect wanted = rectOf(part) & all;
  float low = 0.0F, high = 0.0F;
  if (wanted.empty() || !rangeIn(scene.disparity(wanted), low, high))
    return;
  // room for what lies nearer and farther than was seen, as in the search of ranges
  const float margin = 2.0F + (high - low) / 8.0F;
  low -= margin;
  high += margin;
  const StereoIntrinsics& k = scene.intrinsics;
  StereoWindow window;
  window.min_depth = k.depth(double(high));
  window.max_depth = k.depth(std::max(double(low), detail::DISPARITY_STEP - k.doffs));
  const int reach = static_cast<int>(std::ceil(0.5F * (high - low)));
  window.rect = {wanted.x - reach, wanted.y, wanted.width + 2 * reach, wanted.height};
  const StereoResult fine = matchWindow(scene, window);
  const auto shift = static_cast<float>(fine.intrinsics.doffs - k.doffs);
  const cv::Rect there = rectOf(fine.window) & wanted;
  const cv::Rect in_fine = there - rectOf(fine.window).tl();
  scene.disparity(there) = fine.disparity(in_fine) + shift;
  fine.disparity_sigma(in_fine).copyTo(scene.disparity_sigma(there));
  for (int v = 0; v < there.height; ++v)
    std::copy_n(&fine.cloud->at(in_fine.x, in_fine.y + v),
                there.width,
                &scene.cloud->at(there.x, there.y + v));
  scene.correlation = fine.correlation;
  scene.detail = {there.x, there.y, there.width, there.height};
  scene.timings_ms.insert(
      scene.timings_ms.end(), fine.timings_ms.begin(), fine.timings_ms.end());
}

} // namespace pcl_sq
