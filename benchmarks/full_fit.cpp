// SPDX-License-Identifier: BSD-3-Clause
// Time of the full fit against the number of points: exact points, points with noise,
// and as many outliers as points.
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/triangle_mesh.h"

#include <benchmark/benchmark.h>

#include <random>

namespace {

using namespace pcl_sq;

Eigen::Matrix3Xd cloud(Eigen::Index count, double noise, double outliers) {
  Superquadric s;
  s.center = {0.1, -0.05, 0.8};
  s.rotation =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  s.semi_axes = {0.05, 0.08, 0.11};
  s.epsilon1 = 0.4;
  s.epsilon2 = 0.9;
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0.0, noise);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  const auto on_surface = static_cast<Eigen::Index>((1.0 - outliers) * double(count));
  const std::vector<Eigen::Vector3d> surface =
      sampleUniform(s, static_cast<std::size_t>(on_surface));
  Eigen::Matrix3Xd points(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k)
      points(k, i) = i < on_surface
                         ? surface[static_cast<std::size_t>(i)][k] + normal(engine)
                         : s.center[k] + uniform(engine);
  return points;
}

void fullFit(benchmark::State& state, double noise, double outliers) {
  const Eigen::Matrix3Xd points = cloud(state.range(0), noise, outliers);
  for (auto _ : state) {
    const FitSummary summary = fitSuperquadric(points);
    benchmark::DoNotOptimize(summary);
  }
}

void exact(benchmark::State& state) {
  fullFit(state, 0.0, 0.0);
}
void noisy(benchmark::State& state) {
  fullFit(state, 0.001, 0.0);
}
void cluttered(benchmark::State& state) {
  fullFit(state, 0.0, 0.5);
}

} // namespace

BENCHMARK(exact)
    ->RangeMultiplier(10)
    ->Range(100, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(noisy)
    ->RangeMultiplier(10)
    ->Range(100, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(cluttered)
    ->RangeMultiplier(10)
    ->Range(100, 1000000)
    ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
