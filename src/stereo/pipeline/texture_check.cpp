// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/pipeline/texture_check.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace pcl_sq::detail {
namespace {

cv::Mat grey(const cv::Mat& image) {
  cv::Mat result = image;
  if (image.channels() == 3)
    cv::cvtColor(image, result, cv::COLOR_BGR2GRAY);
  result.convertTo(result, CV_32F);
  return result;
}

} // namespace

TexturedShare
texturedShare(const StereoResult& stereo, const cv::Mat& object, int block) {
  constexpr double SHARED = 0.5;
  // windows of the object's pixels see this much
  const cv::Rect box = cv::boundingRect(object);
  const cv::Rect here = cv::Rect(box.tl() - cv::Point(block, block),
                                 box.size() + cv::Size(2 * block, 2 * block)) &
                        cv::Rect({}, object.size());
  const cv::Mat mask = object(here);
  cv::Mat inner;
  cv::erode(mask,
            inner,
            cv::Mat::ones(block, block, CV_8U),
            {-1, -1},
            1,
            cv::BORDER_CONSTANT,
            cv::Scalar(0));
  const int count = cv::countNonZero(inner);
  if (count < block * block)
    return {};
  const cv::Mat disparity = stereo.disparity(here);
  cv::Mat x(disparity.size(), CV_32F), y(disparity.size(), CV_32F);
  cv::Mat known = disparity > -FLT_MAX; // 0 for NaN, else 255
  for (int v = 0; v < disparity.rows; ++v)
    for (int u = 0; u < disparity.cols; ++u) {
      const float d = disparity.at<float>(v, u);
      x.at<float>(v, u) = static_cast<float>(here.x + u) - (std::isnan(d) ? 0.0f : d);
      y.at<float>(v, u) = static_cast<float>(here.y + v);
    }
  const cv::Mat left = grey(stereo.left(here));
  cv::Mat right;
  cv::remap(grey(stereo.right), right, x, y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::Mat weight;
  known.convertTo(weight, CV_32F, 1.0 / 255.0);
  const auto mean = [&](const cv::Mat& values) {
    cv::Mat sum, total;
    cv::boxFilter(values.mul(weight), sum, CV_32F, {block, block});
    cv::boxFilter(weight, total, CV_32F, {block, block});
    return cv::Mat(sum / cv::max(total, 1e-6));
  };
  const cv::Mat l = mean(left), r = mean(right);
  const cv::Mat covariance = mean(left.mul(right)) - l.mul(r);
  const cv::Mat variances =
      (mean(left.mul(left)) - l.mul(l)).mul(mean(right.mul(right)) - r.mul(r));
  cv::Mat deviations;
  cv::sqrt(cv::max(variances, 0.0), deviations);
  const cv::Mat shared = covariance > SHARED * deviations;
  const double matched = cv::countNonZero(known & inner);
  const double textured = cv::countNonZero(shared & known & inner);
  return {textured / count, textured / std::max(matched, 1.0)};
}

} // namespace pcl_sq::detail
