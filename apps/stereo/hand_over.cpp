// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/hand_over.h"

#include "command_line/app.h"
#include "stereo/stereo_cloud.h"

#include <cmath>
#include <limits>

namespace pcl_sq::app {

namespace {

/** \brief Noise and dilation of an outline that was found: images are cut along edges
 * that are blurred over about three pixels [px]. */
constexpr double FOUND_OUTLINE = 1.5, FOUND_DILATION = 1.0;

} // namespace

void dropStrays(const FrontResult& front, LoadedCloud& scene) {
  constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
  constexpr double REACH =
      0.15; // of the box's diagonal: the aperture cuts thin ends off
  const Eigen::Vector3d margin =
      Eigen::Vector3d::Constant(REACH * front.region.sizes().norm());
  RoiBox box = front.region;
  box.min -= margin;
  box.max += margin;
  const auto* mask = front.segment.mask.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < scene.cloud->size(); ++i) {
    auto& p = (*scene.cloud)[i];
    if (mask[i] != 0 && std::isfinite(p.z) &&
        !box.contains(p.getVector3fMap().cast<double>())) {
      p.x = p.y = p.z = NOTHING;
      --scene.finite_points;
    }
  }
}

void handOver(const FrontResult& front, bool whole_scene, ModelOptions& model) {
  const bool painted = !model.mask.empty();
  model.roi.clear();
  model.mask.clear();
  const CameraIntrinsics& k = front.stereo.intrinsics;
  model.intrinsics = {k.fx, k.fy, k.cx, k.cy};
  if (!whole_scene) {
    if (model.box.empty())
      for (const Eigen::Vector3d& corner : {front.region.min, front.region.max})
        model.box.insert(model.box.end(), corner.data(), corner.data() + 3);
    return;
  }
  tellNoise(front.stereo, model.estimation.view);
  if (!painted) { // what colours and depth find is no painted mask
    model.estimation.view.mask_sigma = FOUND_OUTLINE;
    model.estimation.view.mask_dilation = FOUND_DILATION;
  }
  const cv::Mat& mask = front.segment.mask;
  if (mask.empty()) {
    model.roi = {front.rect.x, front.rect.y, front.rect.width, front.rect.height};
    return;
  }
  CellMask& cells = model.estimation.view.mask;
  cells = CellMask(mask.cols, mask.rows);
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      cells.set(x, y, mask.at<std::uint8_t>(y, x) != 0);
}

void requireNoDoubt(const ModelResult& result) {
  // as much of outline and points must agree as of the object's pixels of any model
  constexpr double LEAST = 0.8;
  const double confidence = result.report.confidence;
  if (confidence < LEAST)
    throw Failure(
        "what was taken for the object agrees with its model by " +
        std::to_string(int(100.0 * confidence)) +
        " % only, so it may be no thing on a table; draw a box around the object "
        "(--roi) or click on it (--click).");
}

void requireBoxFilled(const FrontResult& front, const ModelResult& result) {
  constexpr double LEAST = 0.4;
  const CellMask& pixels = result.report.view.pixels;
  if (!front.segment.mask.empty() || pixels.cells.empty())
    return;
  const double share = double(boundingRect(pixels).area()) /
                       (double(front.rect.width) * double(front.rect.height));
  if (share < LEAST)
    throw Failure("what was found in the box fills " +
                  std::to_string(std::lround(100.0 * share)) +
                  " % of it only, so it is not what the box was drawn around; give a "
                  "mask of the object, or more texture to the pair.");
}

} // namespace pcl_sq::app
