// SPDX-License-Identifier: BSD-3-Clause
// From a depth camera's cloud in memory to models, one thread: the thing of a mask
// where one thing stands on the table, else the whole scene, with labels and without.
//   pcl_sq_benchmark_depth_cloud FOLDER... [options of Google Benchmark]
// Each FOLDER holds cloud.pcd, labels.png and truth.json, as gen_table.py writes them.
#include "pcl_sq/scene_estimation.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <fstream>

using namespace pcl_sq;

namespace {

struct Input {
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZRGB>};
  PinholeCamera camera;
  LabelImage labels;
  std::string things;
  std::size_t count = 0;
};

Input read(const std::string& folder) {
  Input input;
  if (pcl::io::loadPCDFile(folder + "/cloud.pcd", *input.cloud) < 0)
    throw std::runtime_error("no cloud.pcd in " + folder);
  const auto truth = nlohmann::json::parse(std::ifstream(folder + "/truth.json"));
  input.camera.fx = input.camera.fy = truth["camera"]["f"];
  input.camera.cx = truth["camera"]["cx"];
  input.camera.cy = truth["camera"]["cy"];
  const cv::Mat labels = cv::imread(folder + "/labels.png", cv::IMREAD_UNCHANGED);
  if (labels.type() != CV_8U && labels.type() != CV_16U)
    throw std::runtime_error("no labels.png in " + folder);
  input.labels = LabelImage(labels.cols, labels.rows);
  for (int y = 0; y < labels.rows; ++y)
    for (int x = 0; x < labels.cols; ++x)
      input.labels.values[std::size_t(y * labels.cols + x)] =
          labels.depth() == CV_8U ? labels.at<unsigned char>(y, x)
                                  : labels.at<std::uint16_t>(y, x);
  input.count = truth["objects"].size();
  for (const auto& object : truth["objects"])
    input.things +=
        (input.things.empty() ? "" : ",") + object["name"].get<std::string>();
  return input;
}

CellMask maskOf(const LabelImage& labels) {
  CellMask mask(labels.width, labels.height);
  for (std::size_t i = 0; i < labels.values.size(); ++i)
    mask.cells[i] = labels.values[i] == 1;
  return mask;
}

void thing(benchmark::State& state, const Input& input) {
  ObjectSurfaceEstimation<pcl::PointXYZRGB> estimation;
  EstimationOptions options;
  options.view.camera = input.camera;
  options.view.mask = maskOf(input.labels);
  estimation.setOptions(options);
  estimation.setNumberOfThreads(1);
  estimation.setInputCloud(input.cloud);
  MultiSuperquadric model;
  for (auto _ : state)
    if (!estimation.estimate(model))
      state.SkipWithError("no model");
}

void scene(benchmark::State& state, const Input& input, bool labelled) {
  SceneEstimation<pcl::PointXYZRGB> estimation;
  SceneOptions options;
  options.estimation.view.camera = input.camera;
  estimation.setOptions(options);
  if (labelled)
    estimation.setLabels(input.labels);
  estimation.setNumberOfThreads(1);
  estimation.setInputCloud(input.cloud);
  Scene result;
  for (auto _ : state)
    if (!estimation.estimate(result))
      state.SkipWithError(result.failure.c_str());
}

template <class Run>
void add(const std::string& name, Run run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

} // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc < 2) {
    std::fputs("give folders with cloud.pcd, labels.png and truth.json.\n", stderr);
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  std::vector<Input> inputs;
  for (int i = 1; i < argc; ++i)
    inputs.push_back(read(argv[i]));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Input& input = inputs[i];
    const std::string name = std::to_string(i) + "/" + input.things;
    if (input.count == 1)
      add("thing/" + name, [&](benchmark::State& s) { thing(s, input); });
    else {
      add("scene/" + name, [&](benchmark::State& s) { scene(s, input, false); });
      add("labelled/" + name, [&](benchmark::State& s) { scene(s, input, true); });
    }
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
