// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_model.h"

#include "command_line/app.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <pcl/common/io.h>

#include <cmath>
#include <limits>

namespace pcl_sq::app {

namespace {

bool isBest(const ModelOptions& model) {
  return model.estimation.decomposition == Decomposition::PARTS;
}

/** \brief Noise and dilation of an outline that was found: images are cut along edges
 * that are blurred over about three pixels [px]. */
constexpr double FOUND_OUTLINE = 1.5, FOUND_DILATION = 1.0;

/** \brief The stereo cloud in the programs' point type; only \a keep's points stay
 * finite, all of them if it is null. */
LoadedCloud toLoadedCloud(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                          const pcl::Indices* keep) {
  constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();
  LoadedCloud result;
  result.has_color = true;
  result.cloud.reset(new pcl::PointCloud<pcl::PointXYZRGBA>);
  pcl::copyPointCloud(cloud, *result.cloud);
  if (keep != nullptr) {
    std::vector<bool> kept(cloud.size(), false);
    for (const pcl::index_t i : *keep)
      kept[static_cast<std::size_t>(i)] = true;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (!kept[i]) {
        auto& p = (*result.cloud)[i];
        p.x = p.y = p.z = NOTHING;
      }
  }
  for (const auto& p : *result.cloud)
    result.finite_points += std::isfinite(p.z) ? 1 : 0;
  return result;
}

/** \brief Adds what the front half did to the model file. */
void describeFront(const FrontOptions& o, const FrontResult& front, ModelFile& file) {
  std::vector<std::pair<std::string, double>> timings = front.timings_ms;
  double total = 0.0;
  for (const auto& stage : file.timings_ms)
    if (stage.first != "total" && stage.first != "load")
      timings.push_back(stage);
  for (const auto& stage : timings)
    total += stage.second;
  timings.emplace_back("total", total);
  file.timings_ms = timings;
  nlohmann::ordered_json extra = nlohmann::ordered_json::parse(file.extra_json);
  const PixelRect& r = front.rect;
  extra["stereo"] = {
      {"matcher",
       !o.depth.empty()                          ? "depth image"
       : o.stereo.matcher == StereoMatcher::SGBM ? "sgbm"
                                                 : "bm"},
      {"refined", o.depth.empty() && o.stereo.refine},
      {"wls", o.stereo.wls},
      {"coverage", front.stereo.coverage},
      {"roi", {r.x, r.y, r.width, r.height}},
      {"segmented", !front.segment.mask.empty()},
      {"aperture",
       {{"near", front.histogram.nearDepth()}, {"far", front.histogram.farDepth()}}},
      {"camera",
       {{"fx", front.stereo.intrinsics.fx},
        {"fy", front.stereo.intrinsics.fy},
        {"cx", front.stereo.intrinsics.cx},
        {"cy", front.stereo.intrinsics.cy},
        {"baseline", front.stereo.intrinsics.baseline}}}};
  if (!front.notes.empty())
    extra["stereo"]["notes"] = front.notes;
  file.extra_json =
      extra.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/** \brief Takes the points under the object's mask that lie far from its box out of a
 * scene: false matches along the outline, with the depth of what is behind. */
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

/** \brief The pair's own noise as that of its points: Z^2 / (f b) a pixel. */
void tellNoise(const StereoResult& stereo, ViewOptions& view) {
  if (stereo.disparity_sigma.empty())
    return;
  view.correlation = stereo.correlation;
  const double per_pixel = 1.0 / (stereo.intrinsics.fx * stereo.intrinsics.baseline);
  const auto* sigma = stereo.disparity_sigma.ptr<float>();
  view.noise.resize(static_cast<Eigen::Index>(stereo.cloud->size()));
  for (Eigen::Index i = 0; i < view.noise.size(); ++i) {
    const auto z = double((*stereo.cloud)[static_cast<std::size_t>(i)].z);
    view.noise[i] = std::isfinite(z)
                        ? static_cast<float>(z * z * per_pixel * double(sigma[i]))
                        : 1.0F;
  }
}

/** \brief Tells the model half what the images gave. The best mode looks at the whole
 * scene through the outline, the paper's chain at the object's points in their box. */
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

/** \brief Refuses what fills but a piece of the box that was drawn around the object,
 * where no outline tells them apart. */
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

} // namespace

void chooseMatcher(const ModelOptions& model, FrontOptions& front) {
  const bool best = isBest(model);
  front.stereo.matcher =
      front.matcher.value_or(best ? StereoMatcher::SGBM : StereoMatcher::BM);
  front.stereo.refine = front.refine.value_or(best);
}

StereoModel makeStereoModel(const FrontOptions& options,
                            const FrontResult& front,
                            ModelOptions model) {
  const bool best = isBest(model);
  handOver(front, best, model);
  StereoModel made;
  made.object = toLoadedCloud(*front.stereo.cloud, &front.object);
  made.scene = toLoadedCloud(*front.stereo.cloud, nullptr);
  if (!front.segment.mask.empty())
    dropStrays(front, made.scene);
  const std::string input = options.left.empty() ? options.depth : options.left;
  made.result = makeModel(best ? made.scene : made.object, input, model, 0.0);
  if (best)
    requireBoxFilled(front, made.result);
  describeFront(options, front, made.result.file);
  return made;
}

} // namespace pcl_sq::app
