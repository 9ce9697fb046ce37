// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_front.h"

#include "command_line/app.h"
#include "command_line/value_checks.h"
#include "files/files.h"
#include "files/image_file.h"
#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/stage_timer.h"
#include "pcl_sq/stereo/texture_border_filter.h"
#include "stereo/input_images.h"
#include "stereo/texture_check.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::app {
namespace {

CameraIntrinsics givenCamera(const FrontOptions& o) {
  CameraIntrinsics camera;
  camera.fx = o.intrinsics[0];
  camera.fy = o.intrinsics[1];
  camera.cx = o.intrinsics[2];
  camera.cy = o.intrinsics[3];
  return camera;
}

StereoResult loadDepth(const FrontOptions& o, std::vector<std::string>& notes) {
  cv::Mat color = o.left_image;
  if (color.empty() && !o.left.empty())
    color = readImage(o.left, cv::IMREAD_COLOR);
  double scale = o.depth_scale;
  const cv::Mat depth = o.depth_image.empty()
                            ? readDepth(o.depth, scale, notes)
                            : checkedDepth(o.depth_image, o.depth, scale, notes);
  return reprojectDepth(depth, scale, givenCamera(o), color);
}

StereoCalibration calibrationFor(const FrontOptions& o, const cv::Mat& image) {
  if (o.calib.empty()) {
    StereoIntrinsics pair;
    static_cast<CameraIntrinsics&>(pair) = givenCamera(o);
    pair.baseline = o.baseline;
    return StereoCalibration::fromRectified(pair);
  }
  std::vector<CalibrationText> texts;
  for (const std::string& file : o.calib)
    texts.push_back({file, readFile(file)});
  return StereoCalibration::fromText(texts, o.calib_unit, image.cols, image.rows);
}

StereoResult matchPair(const FrontOptions& o, FrontResult& r, StageTimer& timer) {
  cv::Mat left, right;
  timer.run("load", [&] {
    left = o.left_image;
    right = o.right_image;
    if (left.empty())
      readPair(o.left, o.right, left, right, r.notes);
    else
      suitMatcher(o.left, o.right, left, right, r.notes);
    return true;
  });
  StereoReprojector reprojector(calibrationFor(o, left));
  reprojector.setOptions(o.stereo);
  if (o.progress)
    o.progress("match", 0.0);
  StereoResult result = reprojector.compute(left, right);
  const auto& notes = reprojector.getCalibration().getNotes();
  r.notes.insert(r.notes.end(), notes.begin(), notes.end());
  return result;
}

/** \brief The object in the image, by whatever hint there is. */
Segment
findObject(const FrontOptions& o, const std::vector<int>& roi, StereoResult& s) {
  Segment segment;
  if (!o.mask.empty()) {
    const cv::Mat mask = o.mask_image.empty() ? readMask(o.mask) : o.mask_image;
    if (mask.cols != static_cast<int>(s.cloud->width) ||
        mask.rows != static_cast<int>(s.cloud->height))
      throw Failure("the mask and the image differ in size; give a mask of " +
                    std::to_string(s.cloud->width) + " x " +
                    std::to_string(s.cloud->height) +
                    " px, of the rectified left image.");
    segment.mask = mask;
    segment.rect = boundingRect(segment.mask);
    if (segment.rect.empty())
      throw Failure("the mask is empty; paint the object white.");
    return segment;
  }
  ObjectSegmenter segmenter;
  SegmenterOptions options;
  options.method = o.segment == "color" ? SegmentMethod::COLOR : SegmentMethod::GRABCUT;
  segmenter.setOptions(options);
  bool found = false;
  if (!o.click.empty())
    found = segmenter.segmentClick(s.left, o.click[0], o.click[1], *s.cloud, segment);
  else if (!o.color.empty())
    found = segmenter.segmentColor(s.left, o.color[0], o.color[1], o.color[2], segment);
  else if (!roi.empty())
    found = segmenter.segmentBox(
        s.left, {roi[0], roi[1], roi[2], roi[3]}, *s.cloud, segment);
  else if (!s.disparity.empty() && o.stereo.matcher == StereoMatcher::BM) {
    // block matching loses most of a slanted table, so the table is looked for in the
    // denser semi-global disparities
    StereoOptions dense = o.stereo;
    dense.matcher = StereoMatcher::SGBM;
    dense.block_size = 0;
    StereoReprojector reprojector(StereoCalibration::fromRectified(s.intrinsics));
    reprojector.setOptions(dense);
    const StereoResult other = reprojector.compute(s.left, s.right);
    found = segmenter.segmentTabletop(s.left, *other.cloud, segment);
  } else
    found = segmenter.segmentTabletop(s.left, *s.cloud, segment);
  if (!found)
    throw Failure(segmenter.getFailure() + ".");
  return segment;
}

/** \brief Refuses an object of which nothing was matched but its surroundings. */
void requireTexture(const FrontOptions& o, const FrontResult& r) {
  constexpr double LEAST = 0.05; // a label on a plain body is more
  // noise of 121 pixels has a correlation of .5 once in ten million times
  const int block = std::max(11, o.stereo.blockSizeFor(r.stereo.disparity.cols));
  if (!r.stereo.disparity.empty() && r.segment.outlined &&
      texturedShare(r.stereo, r.segment.mask, block) < LEAST)
    throw Failure("nothing on the object was matched: it has no texture, so what the "
                  "matcher gives is noise; put something with texture on it, project a "
                  "pattern, or use a depth camera (--depth).");
}

/** \brief Points of the mask that the border filter keeps. */
void filterBorder(const FrontOptions& o, FrontResult& r) {
  TextureBorderFilter filter;
  filter.setInputCloud(r.stereo.cloud);
  pcl::IndicesPtr indices(new pcl::Indices(r.object));
  filter.setIndices(indices);
  filter.setMask(r.segment.mask);
  filter.setBlockSize(o.stereo.blockSizeFor(static_cast<int>(r.stereo.cloud->width)));
  filter.filter(r.object);
}

pcl::IndicesPtr maskIndices(const cv::Mat& mask) {
  pcl::IndicesPtr indices(new pcl::Indices);
  const auto* m = mask.ptr<std::uint8_t>();
  for (int i = 0; i < static_cast<int>(mask.total()); ++i)
    if (m[i] != 0)
      indices->push_back(i);
  return indices;
}

void findRegion(FrontResult& r) {
  RoiEstimator<pcl::PointXYZRGB> estimator;
  estimator.setInputCloud(r.stereo.cloud);
  estimator.setRect(r.rect);
  if (!r.segment.mask.empty())
    estimator.setIndices(maskIndices(r.segment.mask));
  DepthHistogramOptions options;
  // of a depth camera, bins are relative to the scene's depth
  options.disparity_scale = r.stereo.intrinsics.fx * r.stereo.intrinsics.baseline;
  estimator.setHistogramOptions(options);
  const bool found = estimator.estimate(r.region, r.object);
  r.histogram = estimator.getHistogram();
  if (!found)
    throw Failure("the region of the image holds no cluster of depths; the object was "
                  "not matched: give another region or matcher.");
}

} // namespace

void addFrontOptions(CLI::App& cli, FrontOptions& o) {
  cli.add_option("left", o.left, "Left image (with --depth: the colour image)")
      ->type_name("LEFT");
  cli.add_option("right", o.right, "Right image")->type_name("RIGHT");
  cli.add_option("--calib",
                 o.calib,
                 "Calibration: OpenCV's YAML, XML or JSON, ROS camera_info (left and "
                 "right), Kalibr's camchain, ZED's SN*.conf, Middlebury's calib.txt; "
                 "one file or two")
      ->expected(1, 2)
      ->type_name("FILE");
  cli.add_option("--calib-unit", o.calib_unit, "Length of its unit [m]")
      ->check(positiveNumber(1000.0))
      ->capture_default_str();
  cli.add_option("--baseline",
                 o.baseline,
                 "Distance of the cameras of a rectified pair [m], with --intrinsics "
                 "instead of --calib")
      ->check(positiveNumber(1000.0));
  cli.add_option_function<std::string>(
         "--matcher",
         [&o](const std::string& name) {
           o.matcher = name == "bm" ? StereoMatcher::BM : StereoMatcher::SGBM;
         },
         "Block matching or semi-global; default: bm in the paper's mode only")
      ->check(oneOf({"bm", "sgbm"}));
  cli.add_option(
         "--block-size", o.stereo.block_size, "Matched window [px], odd; 0: auto")
      ->check(wholeNumber(0, 51))
      ->capture_default_str();
  cli.add_option("--min-depth", o.stereo.min_depth, "Nearest depth [m]; 0: found")
      ->check(number(0.0, FARTHEST))
      ->capture_default_str();
  cli.add_option("--max-depth", o.stereo.max_depth, "Farthest depth [m]; 0: found")
      ->check(number(0.0, FARTHEST))
      ->capture_default_str();
  cli.add_option("--uniqueness", o.stereo.uniqueness, "Margin of the best match [%]")
      ->check(wholeNumber(0, 100))
      ->capture_default_str();
  cli.add_option(
         "--left-right", o.stereo.left_right_tolerance, "Check [px]; negative: none")
      ->check(wholeNumber(-1, 100))
      ->capture_default_str();
  cli.add_flag_function(
      "--refine,!--no-refine",
      [&o](std::int64_t given) { o.refine = given > 0; },
      "Least-squares matching with slanted windows after the matcher; default but in "
      "the paper's mode");
  cli.add_flag("--wls", o.stereo.wls, "Edge-aware smoothing of the disparities");
  cli.add_option("--depth",
                 o.depth,
                 "Depth image (16-bit PNG, float TIFF or PFM) instead of a right one")
      ->type_name("FILE");
  cli.add_option("--depth-scale,--depth-unit",
                 o.depth_scale,
                 "Length of one step of it [m]; default: .001 of 16 bits, 1 of floats")
      ->check(positiveNumber(1000.0));
  cli.add_option(
         "--segment",
         o.segment,
         "How the object's outline is found; none: only the box of --roi counts")
      ->default_str("grabcut")
      ->check(oneOf({"none", "color", "grabcut"}));
  cli.add_option("--click", o.click, "Hint: a pixel of the object")
      ->expected(2)
      ->delimiter(',')
      ->type_name("X,Y")
      ->check(wholeNumber(0, MAX_PIXELS));
  cli.add_option("--color", o.color, "Hint: the object's colour, 0 to 255 each")
      ->expected(3)
      ->delimiter(',')
      ->check(wholeNumber(0, 255))
      ->type_name("R,G,B");
  cli.add_flag("--border-filter",
               o.border_filter,
               "Texture-based filter of the object's rim (section IV)");
}

void checkFrontOptions(const FrontOptions& o, const std::vector<int>& roi) {
  std::string why;
  if (!o.stereo.isValid(&why))
    throw UsageError(why + ".");
  if (o.depth.empty()) {
    if (o.left.empty() || o.right.empty())
      throw UsageError("give a left and a right image (or --depth and --intrinsics).");
    if (o.calib.empty() && (o.baseline <= 0.0 || o.intrinsics.size() != 4))
      throw UsageError("--calib is missing; give the calibration of the pair, or "
                       "--intrinsics and --baseline of a rectified one.");
    if (!o.calib.empty() && (o.baseline > 0.0 || !o.intrinsics.empty()))
      throw UsageError(
          "the calibration file says the baseline and the intrinsics; give "
          "either --calib or --intrinsics and --baseline.");
  } else {
    if (!o.right.empty())
      throw UsageError("give either a right image or --depth, not both.");
    if (o.intrinsics.size() != 4)
      throw UsageError("--depth needs --intrinsics FX,FY,CX,CY.");
    if (o.left.empty() && o.mask.empty() && !roi.empty() && o.segment != "none")
      throw UsageError(
          "give the colour image, or --segment none, for the depth image.");
  }
  const bool box_only = o.segment == "none";
  if (!o.mask.empty() && !o.segment.empty() && !box_only)
    throw UsageError("give either --mask or --segment, not both.");
  if (box_only && (roi.empty() || !o.click.empty() || !o.color.empty()))
    throw UsageError("--segment none needs --roi and no other hint.");
  if (o.border_filter && box_only && o.mask.empty())
    throw UsageError(
        "--border-filter needs the object's outline: --segment or --mask.");
}

FrontResult runFront(const FrontOptions& o, const std::vector<int>& roi) {
  FrontResult r;
  StageTimer timer(r.timings_ms, o.progress);
  if (o.depth.empty())
    r.stereo = matchPair(o, r, timer);
  else
    r.stereo = timer.run("load", [&] { return loadDepth(o, r.notes); });
  r.timings_ms.insert(
      r.timings_ms.end(), r.stereo.timings_ms.begin(), r.stereo.timings_ms.end());

  const auto width = static_cast<int>(r.stereo.cloud->width);
  const auto height = static_cast<int>(r.stereo.cloud->height);
  if (!roi.empty() && (roi[0] >= width || roi[1] >= height || roi[0] + roi[2] <= 0 ||
                       roi[1] + roi[3] <= 0))
    throw Failure("--roi lies outside of the image of " + std::to_string(width) +
                  " x " + std::to_string(height) + " px; give a region within it.");
  if (o.segment == "none" && o.mask.empty())
    r.rect = {roi[0], roi[1], roi[2], roi[3]};
  else {
    r.segment = timer.run("segment", [&] { return findObject(o, roi, r.stereo); });
    r.rect = r.segment.rect;
    r.notes.insert(r.notes.end(), r.segment.notes.begin(), r.segment.notes.end());
    requireTexture(o, r);
    if (!r.segment.outlined) // a box has no outline that the object could touch
      r.segment.mask.release();
  }
  timer.run("roi", [&] {
    findRegion(r);
    if (o.border_filter && r.segment.mask.empty())
      throw Failure("colours do not tell the object from its surroundings, so there is "
                    "no outline to filter along; leave out --border-filter.");
    if (o.border_filter)
      filterBorder(o, r);
    return true;
  });
  if (r.object.empty())
    throw Failure("no point of the object is left; leave out --border-filter.");
  return r;
}

} // namespace pcl_sq::app
