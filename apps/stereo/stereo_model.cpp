// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/stereo_model.h"

#include "command_line/app.h"
#include "stereo/hand_over.h"
#include "stereo/stereo_cloud.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

namespace pcl_sq::app {

namespace {

bool isBest(const ModelOptions& model) {
  return model.estimation.decomposition == Decomposition::PARTS;
}

/** \brief Adds what the front half did to the model file. */
void describeFront(const FrontOptions& o, const StereoView& front, ModelFile& file) {
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
  const CellRect &r = front.rect, &window = front.stereo.window;
  extra["stereo"] = {
      {"matcher",
       !o.depth.empty()                          ? "depth image"
       : o.stereo.matcher == StereoMatcher::SGBM ? "sgbm"
                                                 : "bm"},
      {"refined", o.depth.empty() && o.stereo.refine},
      {"wls", o.stereo.wls},
      {"coverage", front.stereo.coverage},
      {"roi", {window.x + r.x, window.y + r.y, r.width, r.height}},
      {"segmented", !front.segment.mask.empty()},
      {"aperture",
       {{"near", front.histogram.nearDepth()}, {"far", front.histogram.farDepth()}}},
      {"camera",
       {{"fx", front.stereo.intrinsics.fx},
        {"fy", front.stereo.intrinsics.fy},
        {"cx", front.stereo.intrinsics.cx + window.x},
        {"cy", front.stereo.intrinsics.cy + window.y},
        {"baseline", front.stereo.intrinsics.baseline}}}};
  if (!front.notes.empty())
    extra["stereo"]["notes"] = front.notes;
  file.extra_json =
      extra.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace

void chooseMatcher(const ModelOptions& model, FrontOptions& front) {
  const bool best = isBest(model);
  front.stereo.matcher =
      front.matcher.value_or(best ? StereoMatcher::SGBM : StereoMatcher::BM);
  front.stereo.refine = front.refine.value_or(best);
}

StereoView readSceneViews(FrontOptions& front, ModelOptions& model) {
  chooseMatcher(model, front);
  StereoView seen = readViews(front);
  const CameraIntrinsics& k = seen.stereo.intrinsics;
  model.intrinsics = {k.fx, k.fy, k.cx, k.cy};
  tellNoise(seen.stereo, model.estimation.view);
  return seen;
}

StereoModel makeStereoModel(const FrontOptions& options,
                            const StereoView& front,
                            ModelOptions model) {
  const bool best = isBest(model);
  const bool hinted = !model.roi.empty() || !model.mask.empty() || !model.box.empty() ||
                      !options.click.empty() || !options.color.empty();
  handOver(front, best, model);
  StereoModel made;
  made.object = toLoadedCloud(*front.stereo.cloud, &front.object);
  made.scene = toLoadedCloud(*front.stereo.cloud, nullptr);
  if (!front.segment.mask.empty())
    dropStrays(front, made.scene);
  const std::string input = options.left.empty() ? options.depth : options.left;
  made.result = makeModel(best ? made.scene : made.object, input, model, 0.0);
  if (const std::string why =
          doubtAbout(front, made.result.report, hinted, !model.mask.empty());
      best && !why.empty())
    throw Failure(why);
  describeFront(options, front, made.result.file);
  return made;
}

} // namespace pcl_sq::app
