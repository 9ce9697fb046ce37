// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/object_masks.h"

#include "stereo/segmentation/color_models.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {
namespace {

/** \brief Filled ellipse in a rectangle. */
cv::Mat ellipseMask(const cv::Size& size, const cv::Rect& rect) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8U);
  const cv::Point center(rect.x + rect.width / 2, rect.y + rect.height / 2);
  cv::ellipse(mask, center, {rect.width / 2, rect.height / 2}, 0, 0, 360, 255, -1);
  return mask;
}

} // namespace

cv::Rect clipped(const cv::Rect& rect, const cv::Mat& image) {
  return rect & cv::Rect(0, 0, image.cols, image.rows);
}

cv::Rect grown(const cv::Rect& rect, double share, const cv::Mat& image) {
  const int dx = std::max(12, static_cast<int>(share * rect.width));
  const int dy = std::max(12, static_cast<int>(share * rect.height));
  return clipped({rect.x - dx, rect.y - dy, rect.width + 2 * dx, rect.height + 2 * dy},
                 image);
}

cv::Mat colorInBox(const cv::Mat& image, const cv::Rect& box, const cv::Rect& window) {
  const cv::Mat part = image(window);
  const cv::Rect inner = box - window.tl();
  const cv::Rect core(inner.x + inner.width / 5,
                      inner.y + inner.height / 8,
                      std::max(1, inner.width * 3 / 5),
                      std::max(1, inner.height * 3 / 4));
  cv::Mat outside(part.size(), CV_8U, cv::Scalar(255));
  outside(inner).setTo(0);
  cv::Mat mask =
      cleanMask(colorProbability(part, ellipseMask(part.size(), core), outside));
  mask.setTo(0, outside);
  return mask;
}

cv::Mat cutInBox(const cv::Mat& image,
                 const cv::Rect& box,
                 const cv::Rect& window,
                 int iterations,
                 Border border) {
  cv::Mat labels(window.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  const cv::Rect inner = box - window.tl();
  // boxes are drawn by hand: just outside of them is hardly the object, not surely not
  const int dx = 1 + inner.width / 40, dy = 1 + inner.height / 40;
  labels(
      clipped({inner.x - dx, inner.y - dy, inner.width + 2 * dx, inner.height + 2 * dy},
              labels))
      .setTo(cv::GC_PR_BGD);
  labels(inner).setTo(cv::GC_PR_FGD);
  return cutGraph(image(window), labels, iterations, border);
}

cv::Mat cutAroundMask(const cv::Mat& image,
                      const cv::Mat& rough,
                      double margin,
                      int iterations) {
  const cv::Rect window = grown(cv::boundingRect(rough), margin, image);
  const cv::Mat part = rough(window);
  const int reach = std::max(4, std::min(window.width, window.height) / 16);
  const cv::Mat round =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  cv::Mat inner, outer;
  cv::erode(part, inner, round);
  cv::dilate(part, outer, round, {-1, -1}, 3); // what stereo did not see
  cv::Mat labels(window.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  labels.setTo(cv::GC_PR_BGD, outer);
  labels.setTo(cv::GC_PR_FGD, part);
  labels.setTo(cv::GC_FGD, inner);
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8U);
  cutGraph(image(window), labels, iterations).copyTo(mask(window));
  return mask;
}

cv::Mat nearColor(const cv::Mat& bgr, const cv::Vec3b& color, double radius) {
  cv::Mat smooth, lab, one(1, 1, CV_8UC3, cv::Scalar(color[0], color[1], color[2]));
  cv::GaussianBlur(bgr, smooth, {7, 7}, 0.0);
  cv::cvtColor(smooth, lab, cv::COLOR_BGR2Lab);
  cv::cvtColor(one, one, cv::COLOR_BGR2Lab);
  const cv::Vec3b wanted = one.at<cv::Vec3b>(0, 0);
  cv::Mat mask(bgr.size(), CV_8U);
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const cv::Vec3b& c = lab.at<cv::Vec3b>(v, u);
      // brightness changes with the light, the other two hardly
      const double l = 0.3 * (c[0] - wanted[0]);
      const double d = std::hypot(l, c[1] - wanted[1], c[2] - wanted[2]);
      mask.at<std::uint8_t>(v, u) = d < radius ? 255 : 0;
    }
  return mask;
}

cv::Mat growColors(const cv::Mat& bgr, const cv::Point& place) {
  const int r = std::max(2, bgr.cols / 150);
  const cv::Rect patch = clipped({place.x - r, place.y - r, 2 * r + 1, 2 * r + 1}, bgr);
  cv::Mat object = cv::Mat::zeros(bgr.size(), CV_8U);
  object(patch).setTo(255);
  for (int round = 0; round < 3; ++round) {
    const cv::Mat background = object == 0;
    object = componentAt(cleanMask(colorProbability(bgr, object, background)) | object,
                         place);
  }
  return object;
}

double coverage(const cv::Mat& mask, const cv::Mat& likely) {
  // matching with windows makes objects fatter than they are
  const cv::Rect box = cv::boundingRect(likely);
  const int rim = 2 * std::max(1, std::min(box.width, box.height) / 12) + 1;
  cv::Mat inner;
  cv::erode(likely,
            inner,
            cv::getStructuringElement(cv::MORPH_ELLIPSE, {rim, rim}),
            {-1, -1},
            1,
            cv::BORDER_CONSTANT,
            cv::Scalar(0));
  const int area = cv::countNonZero(inner);
  return area == 0 ? 1.0 : static_cast<double>(cv::countNonZero(inner & mask)) / area;
}

} // namespace pcl_sq::detail
