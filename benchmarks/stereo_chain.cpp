// SPDX-License-Identifier: BSD-3-Clause
// From a decoded pair to the model: each stage, and the whole chain cold, warm and in a
// sequence. CPU times are those of all threads.
//   pcl_sq_benchmark_stereo_chain FOLDER [options of Google Benchmark]
// FOLDER holds left.png, right.png, mask.png and calib.yml, as pcl_sq_render writes
// them.
#include "pcl_sq/stereo/stereo_pipeline.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>
#include <pcl/console/print.h>

#include <sys/resource.h>

#include <cstdio>

using namespace pcl_sq;

namespace {

struct Pair {
  cv::Mat left, right;
  StereoCalibration calibration;
  StereoHint box; ///< as a hand draws it
} pair;

StereoReprojector reprojector(bool refine) {
  StereoReprojector result(pair.calibration);
  StereoOptions options;
  options.matcher = StereoMatcher::SGBM;
  options.refine = refine;
  result.setOptions(options);
  return result;
}

StereoPipeline pipeline(bool following) {
  StereoPipeline result(pair.calibration);
  result.setOptions({});
  result.setFollowing(following);
  return result;
}

void tellMemory(benchmark::State& state) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = double(usage.ru_maxrss) / 1024.0;
}

/** \brief \a refine, or the matcher's own disparities. */
void cloud(benchmark::State& state, bool refine) {
  StereoReprojector stereo = reprojector(refine);
  for (auto _ : state)
    benchmark::DoNotOptimize(stereo.compute(pair.left, pair.right));
  tellMemory(state);
}

void segment(benchmark::State& state) {
  const StereoResult scene = reprojector(true).compute(pair.left, pair.right);
  Segment result;
  for (auto _ : state)
    if (!ObjectSegmenter().segmentTabletop(scene.left, *scene.cloud, result))
      state.SkipWithError("no object");
  tellMemory(state);
}

void model(benchmark::State& state) {
  const StereoView view = pipeline(false).look(pair.left, pair.right);
  ObjectSurfaceEstimation<pcl::PointXYZRGB> estimation;
  EstimationOptions options;
  tellView(view, false, options.view);
  estimation.setOptions(options);
  estimation.setInputCloud(view.stereo.cloud);
  MultiSuperquadric result;
  for (auto _ : state)
    if (!estimation.estimate(result))
      state.SkipWithError("no model");
  tellMemory(state);
}

void chainCold(benchmark::State& state) {
  StereoObject result;
  for (auto _ : state)
    if (!pipeline(false).process(pair.left, pair.right, result))
      state.SkipWithError(result.failure.c_str());
  tellMemory(state);
}

/** \brief The first frame is not counted. */
void chain(benchmark::State& state, bool following, const StereoHint& hint = {}) {
  StereoPipeline chain = pipeline(following);
  StereoPipelineOptions options = chain.getOptions();
  options.hint = hint;
  chain.setOptions(options);
  StereoObject result;
  if (!chain.process(pair.left, pair.right, result))
    state.SkipWithError(result.failure.c_str());
  for (auto _ : state)
    if (!chain.process(pair.left, pair.right, result))
      state.SkipWithError(result.failure.c_str());
  for (const auto& stages : {result.view.timings_ms, result.report.timings_ms})
    for (const auto& [stage, ms] : stages)
      state.counters[stage + "_ms"] = ms;
  tellMemory(state);
}

void add(const char* name, void (*run)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, run)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

} // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fputs("give a folder with left.png, right.png, mask.png and calib.yml.\n",
               stderr);
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const std::string folder = std::string(argv[1]) + "/";
  pair.left = cv::imread(folder + "left.png");
  pair.right = cv::imread(folder + "right.png");
  pair.calibration = StereoCalibration::load(folder + "calib.yml");
  const CellRect mask = boundingRect(cv::imread(folder + "mask.png", 0));
  constexpr int OFF = 8; // of a box that is drawn [px]
  pair.box.box = {
      mask.x - OFF, mask.y - OFF, mask.width + 2 * OFF, mask.height + 2 * OFF};
  add("cloud/matched", [](benchmark::State& s) { cloud(s, false); });
  add("cloud/refined", [](benchmark::State& s) { cloud(s, true); });
  add("segment", segment);
  add("model", model);
  add("chain/cold", chainCold);
  add("chain/warm", [](benchmark::State& s) { chain(s, false); });
  add("chain/box", [](benchmark::State& s) { chain(s, false, pair.box); });
  add("chain/sequence", [](benchmark::State& s) { chain(s, true); });
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
