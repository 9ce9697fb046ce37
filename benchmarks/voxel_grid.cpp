// SPDX-License-Identifier: BSD-3-Clause
// Voxel grid and prism stage beside pcl::VoxelGrid with the same cells, on the visible
// half of a bottle's body with depth noise.
#include "pcl_sq/adaptive_voxel_grid.h"
#include "pcl_sq/prism_segmentation.h"

#include <benchmark/benchmark.h>

#include <pcl/filters/voxel_grid.h>

#include <cmath>
#include <random>

namespace {

template <typename PointT>
typename pcl::PointCloud<PointT>::ConstPtr cloudOf(std::int64_t count) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> angle(-1.5f, 1.5f), along(0.0f, 0.35f);
  std::normal_distribution<float> noise(0.0f, 0.001f);
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  cloud->resize(static_cast<std::size_t>(count));
  for (PointT& point : *cloud) {
    const float a = angle(engine);
    point.x = 0.0265f * std::sin(a);
    point.y = along(engine);
    point.z = 1.134f - 0.0265f * std::cos(a) + noise(engine);
  }
  return cloud;
}

template <typename PointT>
void pclVoxelGrid(benchmark::State& state) {
  const auto cloud = cloudOf<PointT>(state.range(0));
  pcl_sq::AdaptiveVoxelGrid<PointT> ours; // for the same cells
  pcl::PointCloud<PointT> voxels;
  ours.setInputCloud(cloud);
  ours.filter(voxels);
  const Eigen::Vector3f leaf = ours.getLeafSize();
  pcl::VoxelGrid<PointT> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf.x(), leaf.y(), leaf.z());
  for (auto _ : state)
    grid.filter(voxels);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <typename PointT>
void adaptiveVoxelGrid(benchmark::State& state) {
  const auto cloud = cloudOf<PointT>(state.range(0));
  pcl_sq::AdaptiveVoxelGrid<PointT> grid;
  grid.setInputCloud(cloud);
  pcl::PointCloud<PointT> voxels;
  for (auto _ : state)
    grid.filter(voxels);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <typename PointT>
void voxelsAndPrisms(benchmark::State& state) {
  const auto cloud = cloudOf<PointT>(state.range(0));
  pcl_sq::AdaptiveVoxelGrid<PointT> grid;
  pcl_sq::PrismSegmentation<PointT> prisms;
  grid.setInputCloud(cloud);
  prisms.setInputCloud(cloud);
  pcl::PointCloud<PointT> voxels;
  std::vector<pcl::PointIndices> clusters;
  for (auto _ : state) {
    grid.filter(voxels);
    prisms.setVoxelLayout(grid.getVoxelLayout());
    if (!prisms.segment(clusters))
      state.SkipWithError("no prisms");
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

} // namespace

BENCHMARK_TEMPLATE(pclVoxelGrid, pcl::PointXYZ)
    ->RangeMultiplier(10)
    ->Range(10000, 10000000);
BENCHMARK_TEMPLATE(adaptiveVoxelGrid, pcl::PointXYZ)
    ->RangeMultiplier(10)
    ->Range(10000, 10000000);
BENCHMARK_TEMPLATE(voxelsAndPrisms, pcl::PointXYZ)
    ->RangeMultiplier(10)
    ->Range(10000, 10000000);
BENCHMARK_TEMPLATE(pclVoxelGrid, pcl::PointXYZRGB)->Arg(23000)->Arg(1000000);
BENCHMARK_TEMPLATE(adaptiveVoxelGrid, pcl::PointXYZRGB)->Arg(23000)->Arg(1000000);
BENCHMARK_TEMPLATE(voxelsAndPrisms, pcl::PointXYZRGB)->Arg(23000)->Arg(1000000);

BENCHMARK_MAIN();
