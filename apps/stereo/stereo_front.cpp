// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_front.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/image_file.h"
#include "pcl_sq/stage_timer.h"
#include "stereo/input_images.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

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

StereoCalibration calibrationFor(const FrontOptions& o, const cv::Size& size) {
  if (o.calib.empty()) {
    StereoIntrinsics pair;
    static_cast<CameraIntrinsics&>(pair) = givenCamera(o);
    pair.baseline = o.baseline;
    return StereoCalibration::fromRectified(pair);
  }
  std::vector<CalibrationText> texts;
  for (const std::string& file : o.calib)
    texts.push_back({file, readFile(file)});
  return StereoCalibration::fromText(texts, o.calib_unit, size.width, size.height);
}

/** \brief Reads what is no image in memory. */
void readImages(const FrontOptions& o,
                cv::Mat& left,
                cv::Mat& right,
                std::vector<std::string>& notes) {
  left = o.left_image;
  right = o.right_image;
  if (left.empty())
    readPair(o.left, o.right, left, right, notes);
  else
    suitMatcher(o.left, o.right, left, right, notes);
}

StereoHint hintOf(const FrontOptions& o, const std::vector<int>& roi) {
  StereoHint hint;
  if (!o.mask.empty())
    hint.mask = o.mask_image.empty() ? readMask(o.mask) : o.mask_image;
  else if (!o.click.empty())
    hint.click = {o.click[0], o.click[1]};
  else if (!o.color.empty())
    hint.color = {o.color[0], o.color[1], o.color[2]};
  if (!roi.empty())
    hint.box = {roi[0], roi[1], roi[2], roi[3]};
  hint.box_only = o.segment == "none";
  return hint;
}

} // namespace

StereoPipeline
makePipeline(const FrontOptions& o, const std::vector<int>& roi, const cv::Size& size) {
  StereoPipeline pipeline(o.depth.empty() ? calibrationFor(o, size)
                                          : StereoCalibration());
  StereoPipelineOptions options;
  options.stereo = o.stereo;
  options.hint = hintOf(o, roi);
  options.segmentation =
      o.segment == "color" ? SegmentMethod::COLOR : SegmentMethod::GRABCUT;
  options.border_filter = o.border_filter;
  options.progress = o.progress;
  pipeline.setOptions(options);
  pipeline.setFollowing(o.sequence);
  return pipeline;
}

StereoView readViews(const FrontOptions& o) {
  std::vector<std::pair<std::string, double>> timings;
  std::vector<std::string> notes;
  StageTimer timer(timings, o.progress);
  StereoView view;
  if (o.depth.empty()) {
    cv::Mat left, right;
    timer.run("load", [&] {
      readImages(o, left, right, notes);
      return true;
    });
    view = makePipeline(o, {}, left.size()).see(left, right);
  } else
    view.stereo = timer.run("load", [&] { return loadDepth(o, notes); });
  view.notes.insert(view.notes.begin(), notes.begin(), notes.end());
  return view;
}

StereoView runFront(const FrontOptions& o,
                    const std::vector<int>& roi,
                    std::optional<StereoPipeline>& pipeline) {
  std::vector<std::pair<std::string, double>> timings;
  std::vector<std::string> notes;
  StageTimer timer(timings, o.progress);
  cv::Mat left, right;
  StereoResult depth;
  timer.run("load", [&] {
    if (o.depth.empty())
      readImages(o, left, right, notes);
    else
      depth = loadDepth(o, notes);
    return true;
  });
  if (!pipeline)
    pipeline = makePipeline(o, roi, left.size());
  StereoView view =
      o.depth.empty() ? pipeline->look(left, right) : pipeline->look(std::move(depth));
  view.notes.insert(view.notes.begin(), notes.begin(), notes.end());
  view.timings_ms.insert(view.timings_ms.begin(), timings.begin(), timings.end());
  return view;
}

} // namespace pcl_sq::app
