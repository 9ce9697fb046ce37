// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/object_segmenter.h"

#include "stereo/segmentation/color_models.h"
#include "stereo/segmentation/depth_objects.h"
#include "stereo/segmentation/joint_cut.h"
#include "stereo/segmentation/object_masks.h"

#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>

namespace pcl_sq {

using namespace detail;

namespace {

cv::Mat toBgr(const cv::Mat& image) {
  if (image.channels() == 3)
    return image;
  cv::Mat bgr;
  cv::cvtColor(
      image, bgr, image.channels() == 4 ? cv::COLOR_BGRA2BGR : cv::COLOR_GRAY2BGR);
  return bgr;
}

/** \brief A dark image as bright as others: colours are told apart in steps of the
 * whole range. */
cv::Mat brightened(const cv::Mat& bgr) {
  constexpr double BRIGHTEST = 0.01; // of the values, which may be lamps and glints
  cv::Mat values = bgr.clone().reshape(1, 1), result;
  auto* first = values.ptr<std::uint8_t>();
  auto* high = first + std::ptrdiff_t((1.0 - BRIGHTEST) * values.cols);
  std::nth_element(first, high, first + values.cols);
  cv::convertScaleAbs(bgr, result, 255.0 / std::max<double>(1.0, *high));
  return result;
}

constexpr double HALF_SEEN = 0.4; // of a box's area, by the box of what is found in it
/** The same where depth helps: boxes drawn by hand are off by a tenth on each side. */
constexpr double DRAWN = 0.75;
constexpr double AGREES = 0.85; // of pixels that colours put on their side
constexpr double PIECE = 0.7;   // colours that see less of it than this see a piece

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
                 "color_radius must lie in [1, 100]") &&
         require(disparity_scale >= 0.0 && std::isfinite(disparity_scale),
                 "disparity_scale must not be negative");
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
  mask = largestComponents(mask);
  fillSmallHoles(mask, 0.01);
  const int area = cv::countNonZero(mask);
  if (area < 9 || area < options_.min_share * static_cast<double>(mask.total()))
    return fail(method, "no object was found; give another hint", segment);
  segment.mask = mask;
  segment.rect = boundingRect(mask);
  failure_.clear();
  return true;
}

bool ObjectSegmenter::segmentBox(const cv::Mat& image,
                                 const CellRect& box,
                                 Segment& segment) {
  return segmentBox(image, box, pcl::PointCloud<pcl::PointXYZRGB>(), segment);
}

bool ObjectSegmenter::segmentBox(const cv::Mat& image,
                                 const CellRect& box,
                                 const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                 Segment& segment) {
  if (image.empty() || image.depth() != CV_8U)
    return fail("segmentBox", "the image must be 8-bit and not empty", segment);
  if (!cloud.empty() && !sameSize(image, cloud))
    return fail("segmentBox", "image and cloud differ in size", segment);
  const cv::Rect inside = clipped({box.x, box.y, box.width, box.height}, image);
  if (box.empty() || inside.width < 4 || inside.height < 4)
    return fail("segmentBox",
                "the box lies outside of the image or is empty; give one within it",
                segment);
  const cv::Mat bgr = brightened(toBgr(image));
  const cv::Rect window = grown(inside, options_.margin, bgr);
  if (window == inside)
    return fail("segmentBox",
                "the box is the whole image, so nothing shows the background; give a "
                "smaller box",
                segment);
  std::vector<std::string> notes;
  cv::Mat mask = cv::Mat::zeros(bgr.size(), CV_8U), depth_odds;
  const auto byColors = [&](Border border) {
    const cv::Mat in_window =
        options_.method == SegmentMethod::COLOR
            ? colorInBox(bgr, inside, window)
            : cutInBox(bgr, inside, window, options_.iterations, border);
    in_window.copyTo(mask(window));
    mask = largestComponents(mask);
  };
  const bool deep =
      !cloud.empty() && options_.method == SegmentMethod::GRABCUT &&
      depthOddsInBox(cloud, inside, window, options_.disparity_scale, depth_odds);
  if (deep) {
    const cv::Rect inner = inside - window.tl();
    cv::Mat jointly = cv::Mat::zeros(bgr.size(), CV_8U);
    cutJointly(bgr(window), inner, depth_odds, options_.iterations)
        .copyTo(jointly(window));
    jointly = largestComponents(jointly);
    // colours that see more of the box are believed, unless depth sees most of it
    const int seen = cv::boundingRect(jointly).area();
    bool believed = seen >= DRAWN * inside.area();
    if (!believed) {
      byColors(Border::ROUGH);
      believed = seen >= std::max<double>(cv::boundingRect(mask).area(),
                                          HALF_SEEN * inside.area());
    }
    if (believed) {
      mask = jointly;
      if (separability(bgr(window), mask(window)) < AGREES)
        notes.emplace_back(
            "colours alone do not tell the object from its surroundings, so "
            "its depth draws the outline as well; a mask of the object is "
            "surer");
    } else
      byColors(Border::FINE);
  } else
    byColors(Border::FINE);
  const bool told = cv::boundingRect(mask).area() >= HALF_SEEN * inside.area();
  if (!told) {
    notes.assign(1,
                 "colours do not tell the object from its surroundings, so the "
                 "whole box is used without an outline; a mask of the object "
                 "gives a better model");
    PCL_WARN("[pcl_sq::ObjectSegmenter::segmentBox] %s.\n", notes.front().c_str());
    mask(inside).setTo(255);
  }
  const bool found = finish("segmentBox", mask, segment);
  segment.outlined = told;
  segment.notes = notes;
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
    return fail("segmentClick",
                "the point lies outside of the image; give a pixel within it",
                segment);
  const cv::Mat bgr = toBgr(image);
  cv::Mat rough = growColors(bgr, {x, y});
  cv::Mat patch;
  // colours alone, unless they see but a piece, or lead on to other depths
  if (!cloud.empty() && options_.method == SegmentMethod::GRABCUT &&
      findObjectAt(cloud, {x, y}, patch) &&
      (coverage(rough, patch) < PIECE || shareAtDepthOf(cloud, patch, rough) < PIECE))
    rough = patch;
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
  cv::Mat object = largestComponents(cleanMask(seeds));
  if (cv::countNonZero(object) == 0)
    return fail("segmentColor", "no pixel has that colour; give another one", segment);
  // the object's own colours: darker and lighter spots join in
  const cv::Mat mask = cleanMask(colorProbability(bgr, object, seeds == 0)) | object;
  object = largestComponents(mask);
  if (options_.method == SegmentMethod::GRABCUT)
    object = cutAroundMask(bgr, object, options_.margin, options_.iterations);
  return finish("segmentColor", object, segment);
}

bool ObjectSegmenter::segmentMask(const cv::Mat& image,
                                  const cv::Mat& rough,
                                  Segment& segment) {
  if (image.empty() || image.depth() != CV_8U || rough.size() != image.size())
    return fail("segmentMask",
                "the image must be 8-bit and not empty, the mask of its size",
                segment);
  if (cv::countNonZero(rough) == 0)
    return fail("segmentMask", "the mask is empty", segment);
  return finish(
      "segmentMask",
      cutAroundMask(toBgr(image), rough, options_.margin, options_.iterations),
      segment);
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
  if (!findTableObject(cloud, rough, why))
    return fail("segmentTabletop", why, segment);
  if (!image.empty())
    rough = cutAroundMask(toBgr(image), rough, options_.margin, options_.iterations);
  return finish("segmentTabletop", rough, segment);
}

CellRect boundingRect(const cv::Mat& mask) {
  const cv::Rect r = cv::boundingRect(mask);
  return {r.x, r.y, r.width, r.height};
}

} // namespace pcl_sq
