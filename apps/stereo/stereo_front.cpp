// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_front.h"

#include "command_line/app.h"
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
  constexpr double MAJORITY =
      0.5; // where most of the matches are noise, so is the model
  // noise of 121 pixels has a correlation of .5 once in ten million times
  const int block = std::max(11, o.stereo.blockSizeFor(r.stereo.disparity.cols));
  if (r.stereo.disparity.empty() || !r.segment.outlined)
    return;
  const TexturedShare share = texturedShare(r.stereo, r.segment.mask, block);
  if (share.of_pixels < LEAST || share.of_matches < MAJORITY)
    throw Failure(
        "hardly anything on the object was matched: it has no texture, so what "
        "the matcher gives is noise; put something with texture on it, project a "
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

FrontResult readViews(const FrontOptions& o) {
  FrontResult r;
  StageTimer timer(r.timings_ms, o.progress);
  if (o.depth.empty())
    r.stereo = matchPair(o, r, timer);
  else
    r.stereo = timer.run("load", [&] { return loadDepth(o, r.notes); });
  r.timings_ms.insert(
      r.timings_ms.end(), r.stereo.timings_ms.begin(), r.stereo.timings_ms.end());
  return r;
}

FrontResult runFront(const FrontOptions& o, const std::vector<int>& roi) {
  FrontResult r = readViews(o);
  StageTimer timer(r.timings_ms, o.progress);
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
