// SPDX-License-Identifier: BSD-3-Clause
// Time per point of the solver's inner loops, for each instruction set and residual.
#include "kernels/kernels.h"

#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

namespace {

using namespace pcl_sq::kernels;

constexpr std::size_t COUNT = 2048;

/** \brief Points about the unit sphere and a superquadric near it. */
struct Scene {
  std::vector<float> x, y, z;
  Shape shape{};
  Scene() : x(COUNT), y(COUNT), z(COUNT) {
    std::mt19937 engine(1);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < COUNT; ++i) {
      const float p[] = {normal(engine), normal(engine), normal(engine)};
      const float length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      x[i] = p[0] / length;
      y[i] = p[1] / length;
      z[i] = p[2] / length;
    }
    for (int k = 0; k < 3; ++k) {
      shape.axes[k][k] = 1.0F;
      shape.inverse_axis[k] = 1.0F - 0.1F * static_cast<float>(k);
    }
    shape.epsilon1 = 0.8F;
    shape.epsilon2 = 1.3F;
  }
  Points points() const { return {x.data(), y.data(), z.data(), nullptr, COUNT}; }
};

void normalEquations(benchmark::State& state,
                     const Kernels* kernels,
                     Residual residual,
                     float outlier) {
  const Scene scene;
  Sums sums;
  for (auto _ : state) {
    kernels->normalEquations(
        scene.points(), scene.shape, residual, {50.0F, outlier}, sums);
    benchmark::DoNotOptimize(sums);
  }
  state.counters["ns_per_point"] =
      benchmark::Counter(double(COUNT) * double(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void residuals(benchmark::State& state, const Kernels* kernels, Residual residual) {
  const Scene scene;
  std::vector<float> out(COUNT);
  for (auto _ : state) {
    kernels->residuals(scene.points(), scene.shape, residual, out.data());
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["ns_per_point"] =
      benchmark::Counter(double(COUNT) * double(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

} // namespace

int main(int argc, char** argv) {
  const std::pair<Residual, const char*> kinds[] = {
      {Residual::RADIAL, "radial"},
      {Residual::FOOT_POINT, "foot_point"},
      {Residual::GAUGE, "gauge"}};
  for (const Isa isa : {Isa::PORTABLE, Isa::SSE2, Isa::AVX2, Isa::AVX512})
    if (const Kernels* k = kernelsFor(isa))
      for (const auto& [kind, name] : kinds) {
        const std::string label = std::string("/") + k->name + "/" + name;
        const Residual residual = kind;
        benchmark::RegisterBenchmark(
            ("residuals" + label).c_str(),
            [k, residual](benchmark::State& s) { residuals(s, k, residual); });
        for (const float outlier : {0.0F, 0.1F})
          benchmark::RegisterBenchmark(
              ("normal_equations" + label + (outlier > 0.0F ? "/mixture" : "")).c_str(),
              [k, residual, outlier](benchmark::State& s) {
                normalEquations(s, k, residual, outlier);
              });
      }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
