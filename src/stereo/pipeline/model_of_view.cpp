// SPDX-License-Identifier: BSD-3-Clause
// From what the images gave to the model.
#include "pcl_sq/exception.h"
#include "pcl_sq/stereo/stereo_pipeline.h"
#include "sensor/depth_patch.h"
#include "stereo/pipeline/outline_edges.h"

#include <opencv2/core.hpp>
#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {

void tellNoise(const StereoResult& stereo, ViewOptions& options) {
  if (stereo.disparity_sigma.empty())
    return;
  options.correlation = stereo.correlation;
  const double per_pixel = 1.0 / (stereo.intrinsics.fx * stereo.intrinsics.baseline);
  const auto* sigma = stereo.disparity_sigma.ptr<float>();
  options.noise.resize(static_cast<Eigen::Index>(stereo.cloud->size()));
  for (Eigen::Index i = 0; i < options.noise.size(); ++i) {
    const auto z = double((*stereo.cloud)[static_cast<std::size_t>(i)].z);
    options.noise[i] = std::isfinite(z)
                           ? static_cast<float>(z * z * per_pixel * double(sigma[i]))
                           : 1.0F;
  }
}

void tellView(const StereoView& view, bool painted, ViewOptions& options) {
  // noise and dilation of an outline that was found: images are cut along edges that
  // are blurred over about three pixels
  constexpr double FOUND_OUTLINE = 1.5, FOUND_DILATION = 1.0;
  options.camera = PinholeCamera{view.stereo.intrinsics};
  tellNoise(view.stereo, options);
  if (!painted) {
    options.mask_sigma = FOUND_OUTLINE;
    options.mask_dilation = FOUND_DILATION;
    options.mask_correlation = detail::OUTLINE_CORRELATION;
  }
  const cv::Mat& mask = view.segment.mask;
  options.mask = CellMask();
  if (mask.empty())
    return;
  options.mask = CellMask(mask.cols, mask.rows);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      options.mask.set(x, y, mask.at<std::uint8_t>(y, x) != 0);
}

namespace {

/** \brief What was found of the object, by its outline or by depth alone. */
cv::Mat objectOf(const StereoView& view, const CellMask& pixels) {
  if (!view.segment.mask.empty() || pixels.cells.empty())
    return view.segment.mask;
  cv::Mat mask(pixels.height, pixels.width, CV_8U);
  std::copy(pixels.cells.begin(), pixels.cells.end(), mask.ptr<std::uint8_t>());
  return mask;
}

} // namespace

std::string doubtAbout(const StereoView& view,
                       const EstimationReport& report,
                       bool hinted,
                       bool painted) {
  constexpr double LEAST_FILLED = 0.4;
  // as much of outline and points must agree as of the object's pixels of any model
  constexpr double LEAST_CONFIDENCE = 0.8;
  // no hand opens so much wider than what it is to grasp [m]
  constexpr double FARTHEST_OFF = 0.03;
  const CellMask& pixels = report.view.pixels;
  if (view.segment.mask.empty() && !pixels.cells.empty()) {
    const double share = double(boundingRect(pixels).area()) /
                         (double(view.rect.width) * double(view.rect.height));
    if (share < LEAST_FILLED)
      return "what was found in the box fills " +
             std::to_string(std::lround(100.0 * share)) +
             " % of it only, so it is not what the box was drawn around; give a "
             "mask of the object, or more texture to the pair.";
  }
  // who paints a mask says where the object ends
  if (!painted && detail::outlineEdges(view.stereo, objectOf(view, pixels)).isPiece())
    return "what was found goes on beyond its outline as one flat surface, so it is a "
           "piece of a wall, a table or another thing; draw the box around a whole "
           "thing, or give a mask of the object.";
  if (report.rms_distance > FARTHEST_OFF)
    return "the object's points lie " +
           std::to_string(std::lround(1e3 * report.rms_distance)) +
           " mm off the model, which is of no use to a hand: from so far the pair does "
           "not see better, or it is no one thing; take it from nearer, or give a "
           "tighter region or a mask of the object.";
  if (!hinted && report.confidence < LEAST_CONFIDENCE)
    return "what was taken for the object agrees with its model by " +
           std::to_string(int(100.0 * report.confidence)) +
           " % only, so it may be no thing on a table; draw a box around the object "
           "(--roi) or click on it (--click).";
  return {};
}

bool StereoPipeline::process(const cv::Mat& left,
                             const cv::Mat& right,
                             StereoObject& result) {
  const bool followed = following_ && last_;
  result = {};
  try {
    result.view = look(left, right);
  } catch (const Exception& error) {
    const std::string what = error.what();
    const std::size_t place = what.find("] ");
    result.failure = place == std::string::npos ? what : what.substr(place + 2);
  }
  if (result.failure.empty()) {
    const StereoView& view = result.view;
    constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
    for (const pcl::index_t i : view.strays) {
      auto& p = (*view.stereo.cloud)[static_cast<std::size_t>(i)];
      p.x = p.y = p.z = NOTHING;
    }
    ObjectSurfaceEstimation<pcl::PointXYZRGB> estimation;
    estimation.setInputCloud(view.stereo.cloud);
    EstimationOptions options = options_.estimation;
    if (options.decomposition == Decomposition::PARTS)
      tellView(view, !options_.hint.mask.empty(), options.view);
    if (view.segment.mask.empty() || options.decomposition != Decomposition::PARTS) {
      estimation.setIndices(pcl::make_shared<pcl::Indices>(view.object));
      estimation.setRegion(view.region);
    }
    estimation.setOptions(options);
    estimation.setNumberOfThreads(options_.threads);
    const bool found = estimation.estimate(result.model);
    result.report = estimation.getReport();
    result.failure = result.report.failure;
    if (found && options.decomposition == Decomposition::PARTS)
      result.failure = doubtAbout(
          view, result.report, !options_.hint.empty(), !options_.hint.mask.empty());
  }
  if (result.failure.empty())
    return true;
  reset();
  if (followed) // perhaps the scene is another one
    return process(left, right, result);
  result.model.parts.clear();
  PCL_WARN("[pcl_sq::StereoPipeline::process] %s\n", result.failure.c_str());
  return false;
}

} // namespace pcl_sq
