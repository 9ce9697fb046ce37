// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/object_segmenter.h"

#include "stereo/color_models.h"
#include "stereo/depth_objects.h"

#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>

namespace pcl_sq {
namespace {

cv::Mat toBgr(const cv::Mat& image) {
  if (image.channels() == 3)
    return image;
  cv::Mat bgr;
  cv::cvtColor(
      image, bgr, image.channels() == 4 ? cv::COLOR_BGRA2BGR : cv::COLOR_GRAY2BGR);
  return bgr;
}

cv::Rect clipped(const cv::Rect& rect, const cv::Mat& image) {
  return rect & cv::Rect(0, 0, image.cols, image.rows);
}

cv::Rect grown(const cv::Rect& rect, double share, const cv::Mat& image) {
  const int dx = std::max(12, static_cast<int>(share * rect.width));
  const int dy = std::max(12, static_cast<int>(share * rect.height));
  return clipped({rect.x - dx, rect.y - dy, rect.width + 2 * dx, rect.height + 2 * dy},
                 image);
}

/** \brief Filled ellipse in a rectangle. */
cv::Mat ellipseMask(const cv::Size& size, const cv::Rect& rect) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8U);
  const cv::Point center(rect.x + rect.width / 2, rect.y + rect.height / 2);
  cv::ellipse(mask, center, {rect.width / 2, rect.height / 2}, 0, 0, 360, 255, -1);
  return mask;
}

/** \brief The object in a box, by colour histograms of the box's core and of its
 * surroundings. \param[in] window part of the image that is looked at */
cv::Mat colorInBox(const cv::Mat& image, const cv::Rect& box, const cv::Rect& window) {
  const cv::Mat part = image(window);
  const cv::Rect inner = box - window.tl();
  const cv::Rect core(inner.x + inner.width / 5,
                      inner.y + inner.height / 8,
                      std::max(1, inner.width * 3 / 5),
                      std::max(1, inner.height * 3 / 4));
  cv::Mat outside(part.size(), CV_8U, cv::Scalar(255));
  outside(inner).setTo(0);
  cv::Mat mask = detail::cleanMask(
      detail::colorProbability(part, ellipseMask(part.size(), core), outside));
  mask.setTo(0, outside);
  return mask;
}

/** \brief The object in a box by a graph cut. \param[in] depth_labels what the cloud
 * says of the window's pixels; empty without a cloud */
cv::Mat cutInBox(const cv::Mat& image,
                 const cv::Rect& box,
                 const cv::Rect& window,
                 const cv::Mat& depth_labels,
                 int iterations) {
  cv::Mat labels(window.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  const cv::Rect inner = box - window.tl();
  // boxes are drawn by hand: just outside of them is hardly the object, not surely not
  const int dx = 1 + inner.width / 40, dy = 1 + inner.height / 40;
  labels(
      clipped({inner.x - dx, inner.y - dy, inner.width + 2 * dx, inner.height + 2 * dy},
              labels))
      .setTo(cv::GC_PR_BGD);
  if (depth_labels.empty())
    labels(inner).setTo(cv::GC_PR_FGD);
  else
    depth_labels(inner).copyTo(labels(inner));
  return detail::cutGraph(image(window), labels, iterations);
}

/** \brief Sharpens a rough mask: its inside is sure, its surroundings are open. */
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
  detail::cutGraph(image(window), labels, iterations).copyTo(mask(window));
  return mask;
}

/** \brief Pixels whose colour is near a given one, in the Lab space. */
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

/** \brief Pixels that hang together with a place by colour: the colours of a patch
 * there, then of what they lead to. */
cv::Mat growColors(const cv::Mat& bgr, const cv::Point& place) {
  const int r = std::max(2, bgr.cols / 150);
  const cv::Rect patch = clipped({place.x - r, place.y - r, 2 * r + 1, 2 * r + 1}, bgr);
  cv::Mat object = cv::Mat::zeros(bgr.size(), CV_8U);
  object(patch).setTo(255);
  for (int round = 0; round < 3; ++round) {
    const cv::Mat background = object == 0;
    object = detail::componentAt(
        detail::cleanMask(detail::colorProbability(bgr, object, background)) | object,
        place);
  }
  return object;
}

/** \brief Share of what depth takes for the object, but for its rim, that a mask has.
 * \param[in] labels of labelObjectInBox() */
double coverage(const cv::Mat& mask, const cv::Mat& labels, const cv::Rect& box) {
  cv::Mat likely = cv::Mat::zeros(labels.size(), CV_8U);
  likely(box).setTo(255, labels(box) == cv::GC_PR_FGD);
  // matching with windows makes objects fatter than they are
  const int rim = 2 * std::max(1, std::min(box.width, box.height) / 12) + 1;
  cv::erode(likely,
            likely,
            cv::getStructuringElement(cv::MORPH_ELLIPSE, {rim, rim}),
            {-1, -1},
            1,
            cv::BORDER_CONSTANT,
            cv::Scalar(0));
  const int area = cv::countNonZero(likely);
  return area == 0 ? 1.0 : static_cast<double>(cv::countNonZero(likely & mask)) / area;
}

bool sameSize(const cv::Mat& image, const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
  return cloud.isOrganized() && image.cols == static_cast<int>(cloud.width) &&
         image.rows == static_cast<int>(cloud.height);
}

} // namespace

bool SegmenterOptions::isValid(std::string* why) const {
  const auto require = [why](bool holds, const char* reason) {
    if (!holds && why != nullptr)
      *why = reason;
    return holds;
  };
  return require(iterations >= 1 && iterations <= 50, "iterations must be 1 to 50") &&
         require(min_share >= 0.0 && min_share < 1.0, "min_share must lie in [0, 1)") &&
         require(margin >= 0.05 && margin <= 2.0, "margin must lie in [0.05, 2]") &&
         require(color_radius >= 1.0 && color_radius <= 100.0,
                 "color_radius must lie in [1, 100]");
}

void ObjectSegmenter::setOptions(const SegmenterOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::ObjectSegmenter::setOptions] %s; the old options are kept.\n",
              why.c_str());
}

bool ObjectSegmenter::fail(const std::string& method,
                           const std::string& why,
                           Segment& segment) {
  segment = Segment();
  failure_ = why;
  PCL_WARN("[pcl_sq::ObjectSegmenter::%s] %s.\n", method.c_str(), why.c_str());
  return false;
}

bool ObjectSegmenter::finish(const std::string& method,
                             cv::Mat mask,
                             Segment& segment) {
  // lines of one or two pixels along edges of the background are no object
  if (mask.cols >= 400)
    cv::morphologyEx(mask,
                     mask,
                     cv::MORPH_OPEN,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  mask = detail::largestComponents(mask);
  detail::fillSmallHoles(mask, 0.01);
  const int area = cv::countNonZero(mask);
  if (area < 9 || area < options_.min_share * static_cast<double>(mask.total()))
    return fail(method, "no object was found; give another hint", segment);
  segment.mask = mask;
  segment.rect = boundingRect(mask);
  failure_.clear();
  return true;
}

bool ObjectSegmenter::segmentBox(const cv::Mat& image,
                                 const PixelRect& box,
                                 Segment& segment) {
  return segmentBox(image, box, pcl::PointCloud<pcl::PointXYZRGB>(), segment);
}

bool ObjectSegmenter::segmentBox(const cv::Mat& image,
                                 const PixelRect& box,
                                 const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                 Segment& segment) {
  if (image.empty() || image.depth() != CV_8U)
    return fail("segmentBox", "the image must be 8-bit and not empty", segment);
  if (!cloud.empty() && !sameSize(image, cloud))
    return fail("segmentBox", "image and cloud differ in size", segment);
  const cv::Rect inside = clipped({box.x, box.y, box.width, box.height}, image);
  if (box.empty() || inside.width < 4 || inside.height < 4)
    return fail("segmentBox", "the box lies outside of the image or is empty", segment);
  const cv::Mat bgr = toBgr(image);
  const cv::Rect window = grown(inside, options_.margin, bgr);
  if (window == inside)
    return fail("segmentBox",
                "the box is the whole image, so nothing shows the background; give a "
                "smaller box",
                segment);
  const auto cut = [&](const cv::Mat& depth_labels) {
    cv::Mat whole = cv::Mat::zeros(bgr.size(), CV_8U);
    const cv::Mat part =
        options_.method == SegmentMethod::COLOR
            ? colorInBox(bgr, inside, window)
            : cutInBox(bgr, inside, window, depth_labels, options_.iterations);
    part.copyTo(whole(window));
    return detail::largestComponents(whole);
  };
  cv::Mat mask = cut(cv::Mat());
  cv::Mat depth_labels;
  // colours alone draw the finer line, unless they see but a piece of what hangs
  // together in depth
  constexpr double PIECE = 0.7;
  if (!cloud.empty() && options_.method == SegmentMethod::GRABCUT &&
      detail::labelObjectInBox(cloud, inside, window, depth_labels))
    if (coverage(mask(window), depth_labels, inside - window.tl()) < PIECE)
      mask = cut(depth_labels);
  const bool told = cv::boundingRect(mask).area() >= 0.4 * inside.area();
  if (!told) {
    PCL_WARN(
        "[pcl_sq::ObjectSegmenter::segmentBox] colours do not tell the object from "
        "its surroundings; the whole box is used.\n");
    mask(inside).setTo(255);
  }
  const bool found = finish("segmentBox", mask, segment);
  segment.outlined = told;
  return found;
}

bool ObjectSegmenter::segmentClick(const cv::Mat& image,
                                   int x,
                                   int y,
                                   Segment& segment) {
  return segmentClick(image, x, y, pcl::PointCloud<pcl::PointXYZRGB>(), segment);
}

bool ObjectSegmenter::segmentClick(const cv::Mat& image,
                                   int x,
                                   int y,
                                   const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                   Segment& segment) {
  if (image.empty() || image.depth() != CV_8U)
    return fail("segmentClick", "the image must be 8-bit and not empty", segment);
  if (!cloud.empty() && !sameSize(image, cloud))
    return fail("segmentClick", "image and cloud differ in size", segment);
  if (x < 0 || y < 0 || x >= image.cols || y >= image.rows)
    return fail("segmentClick", "the point lies outside of the image", segment);
  const cv::Mat bgr = toBgr(image);
  cv::Mat rough;
  const bool by_depth = !cloud.empty() && options_.method == SegmentMethod::GRABCUT &&
                        detail::findObjectAt(cloud, {x, y}, rough);
  if (!by_depth)
    rough = growColors(bgr, {x, y});
  if (cv::countNonZero(rough) > 0.5 * static_cast<double>(rough.total()))
    return fail("segmentClick",
                "the object's colour is that of the background; give a box",
                segment);
  if (options_.method == SegmentMethod::GRABCUT)
    rough = cutAroundMask(bgr, rough, options_.margin, options_.iterations);
  return finish("segmentClick", rough, segment);
}

bool ObjectSegmenter::segmentColor(
    const cv::Mat& image, int red, int green, int blue, Segment& segment) {
  if (image.empty() || image.depth() != CV_8U)
    return fail("segmentColor", "the image must be 8-bit and not empty", segment);
  const auto level = [](int c) {
    return static_cast<std::uint8_t>(std::clamp(c, 0, 255));
  };
  const cv::Mat bgr = toBgr(image);
  const cv::Mat seeds =
      nearColor(bgr, {level(blue), level(green), level(red)}, options_.color_radius);
  cv::Mat object = detail::largestComponents(detail::cleanMask(seeds));
  if (cv::countNonZero(object) == 0)
    return fail("segmentColor", "no pixel has that colour; give another one", segment);
  // the object's own colours: darker and lighter spots join in
  const cv::Mat mask =
      detail::cleanMask(detail::colorProbability(bgr, object, seeds == 0)) | object;
  object = detail::largestComponents(mask);
  if (options_.method == SegmentMethod::GRABCUT)
    object = cutAroundMask(bgr, object, options_.margin, options_.iterations);
  return finish("segmentColor", object, segment);
}

bool ObjectSegmenter::segmentTabletop(const cv::Mat& image,
                                      const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                      Segment& segment) {
  if (!cloud.isOrganized() || cloud.empty())
    return fail("segmentTabletop", "the cloud must be organized", segment);
  if (!image.empty() && !sameSize(image, cloud))
    return fail("segmentTabletop", "image and cloud differ in size", segment);
  cv::Mat rough;
  std::string why;
  if (!detail::findTableObject(cloud, rough, why))
    return fail("segmentTabletop", why, segment);
  if (!image.empty())
    rough = cutAroundMask(toBgr(image), rough, options_.margin, options_.iterations);
  return finish("segmentTabletop", rough, segment);
}

PixelRect boundingRect(const cv::Mat& mask) {
  const cv::Rect r = cv::boundingRect(mask);
  return {r.x, r.y, r.width, r.height};
}

} // namespace pcl_sq
