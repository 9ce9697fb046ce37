// SPDX-License-Identifier: BSD-3-Clause
// The whole paper mode after loading, on one view of a bottle; 23,000 points is the
// paper's own size.
#include "pcl_sq/object_surface_estimation.h"

#include "bottle_view.h"

#include <benchmark/benchmark.h>

using namespace pcl_sq;

namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr bottleCloud(std::size_t points) {
  // both parts are sampled alike and about a third of each is seen
  auto cloud = test::toCloud(test::visiblePoints(test::bottle(), 2 * points, 0.0005));
  cloud->resize(std::min(points, cloud->size()));
  return cloud;
}

void estimate(benchmark::State& state, Decomposition decomposition) {
  const auto cloud = bottleCloud(static_cast<std::size_t>(state.range(0)));
  EstimationOptions options = EstimationOptions::paper();
  options.decomposition = decomposition;
  ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  estimation.setOptions(options);
  estimation.setNumberOfThreads(1);
  MultiSuperquadric model;
  for (auto _ : state) {
    if (!estimation.estimate(model))
      state.SkipWithError("no model");
    benchmark::DoNotOptimize(model);
  }
  for (const auto& [stage, ms] : estimation.getReport().timings_ms)
    state.counters[stage + "_ms"] = ms;
  state.counters["points"] = double(cloud->size());
  state.counters["parts"] = double(model.size());
  state.counters["ns_per_point"] = benchmark::Counter(
      double(cloud->size()) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void paperModePrisms(benchmark::State& state) {
  estimate(state, Decomposition::PRISMS);
}
void paperModeSingle(benchmark::State& state) {
  estimate(state, Decomposition::NONE);
}

} // namespace

BENCHMARK(paperModePrisms)
    ->Arg(10000)
    ->Arg(23000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(10000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(paperModeSingle)->Arg(23000)->Unit(benchmark::kMillisecond);
BENCHMARK_MAIN();
