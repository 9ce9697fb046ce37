// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/adaptive_voxel_grid.h"

#include "clouds.h"

#include <gtest/gtest.h>

#include <pcl/filters/voxel_grid.h>

#include <map>
#include <set>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Grid = AdaptiveVoxelGrid<pcl::PointXYZ>;

namespace {

/** Fills a book of 220 x 300 x 15 mm with its corner at a place. */
Cloud::Ptr book(float x, float y, float z) {
  Cloud::Ptr cloud = randomCloud(20000, 5, 0.0f, 0.0f, 0.0f, 1.0f);
  (*cloud)[0] = {0, 0, 0};
  (*cloud)[1] = {1, 1, 1};
  for (auto& p : *cloud)
    p = {x + 0.220f * p.x, y + 0.300f * p.y, z + 0.015f * p.z};
  return cloud;
}

} // namespace

TEST(AdaptiveVoxelGrid, DivisionsAreExactWhereverTheCloudLies) {
  for (const float shift : {0.0f, 0.0043f, -1.7771f, 3.14159f}) {
    const Cloud::Ptr cloud = book(shift, -shift, 1.1f + shift);
    Grid grid;
    grid.setInputCloud(cloud);
    grid.setPercent({4.5, 3.2, 10.0});
    Cloud output;
    grid.filter(output);
    EXPECT_EQ(grid.getNrDivisions(), Eigen::Vector3i(22, 31, 10));
    EXPECT_EQ(grid.getMinBoxCoordinates(), Eigen::Vector3i(0, 0, 0));
    EXPECT_EQ(grid.getMaxBoxCoordinates(), Eigen::Vector3i(21, 30, 9));
    EXPECT_EQ(grid.getDivisionMultiplier(), Eigen::Vector3i(1, 22, 22 * 31));
    EXPECT_LT((grid.getLeafSize() - Eigen::Vector3f(0.01f, 0.3f / 31, 0.0015f)).norm(),
              1e-5f);
  }
}

TEST(AdaptiveVoxelGrid, OutputIsTheCentroidOfEachValidVoxel) {
  const Cloud::Ptr cloud = book(0.1f, 0.2f, 1.0f);
  const pcl::IndicesPtr indices = someIndices(cloud->size());
  Grid grid;
  grid.setInputCloud(cloud);
  grid.setIndices(indices);
  grid.setMinimumPointsNumberPerVoxel(2);
  Cloud output;
  grid.filter(output);
  std::map<int, std::pair<Eigen::Vector3d, int>> voxels; // in the order of the output
  for (const int i : *indices) {
    const pcl::PointXYZ& p = (*cloud)[static_cast<std::size_t>(i)];
    auto& [sum, count] = voxels
                             .try_emplace(grid.getVoxelLayout().indexOf(p.x, p.y, p.z),
                                          Eigen::Vector3d::Zero(),
                                          0)
                             .first->second;
    sum += p.getVector3fMap().cast<double>();
    ++count;
  }
  std::size_t n = 0;
  for (const auto& [voxel, entry] : voxels) {
    EXPECT_EQ(grid.getVoxelLayout().counts[static_cast<std::size_t>(voxel)],
              static_cast<unsigned>(entry.second));
    if (entry.second < 2)
      continue;
    ASSERT_LT(n, output.size());
    EXPECT_LT(
        (output[n].getVector3fMap().cast<double>() - entry.first / entry.second).norm(),
        1e-6);
    EXPECT_EQ(grid.getCentroidIndex(output[n]), static_cast<int>(n));
    ++n;
  }
  EXPECT_EQ(output.size(), n);
  EXPECT_LT(n, voxels.size()) << "some voxels hold one point and are not valid";
}

TEST(AdaptiveVoxelGrid, AgreesWithPclVoxelGridWhereThatStartsAtTheRegionsCorner) {
  // all cells of 1/16 m, the region's corner at the world's origin: exact in binary
  const Cloud::Ptr cloud = randomCloud(5000, 6, 0.0f, 0.0f, 0.0f, 0.99999f);
  pcl::VoxelGrid<pcl::PointXYZ> theirs;
  theirs.setInputCloud(cloud);
  theirs.setLeafSize(0.0625f, 0.0625f, 0.0625f);
  Grid ours;
  ours.setInputCloud(cloud);
  ours.setRegion({{0, 0, 0}, {1, 1, 1}});
  ours.setDivisions({16, 16, 16});
  ours.setMinimumPointsNumberPerVoxel(1);
  Cloud expected, output;
  theirs.filter(expected);
  ours.filter(output);
  ASSERT_EQ(output.size(), expected.size());
  for (std::size_t i = 0; i < output.size(); ++i)
    EXPECT_LT((output[i].getVector3fMap() - expected[i].getVector3fMap()).norm(),
              1e-6f);
}

TEST(AdaptiveVoxelGrid, RemovedIndicesAreTheFinitePointsInNoValidVoxel) {
  const Cloud::Ptr cloud = randomCloud(3000, 7);
  (*cloud)[8].x = NOT_A_NUMBER;
  cloud->is_dense = true; // not true, and must not matter
  Grid grid(true);
  grid.setInputCloud(cloud);
  grid.setIndices(someIndices(cloud->size(), 2));
  grid.setRegion({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
  grid.setDivisions({5, 5, 5});
  Cloud output;
  grid.filter(output);
  const std::set<int> removed(grid.getRemovedIndices()->begin(),
                              grid.getRemovedIndices()->end());
  ASSERT_GT(removed.size(), 0u);
  std::size_t expected = 0;
  for (const int i : *grid.getIndices()) {
    const pcl::PointXYZ& p = (*cloud)[static_cast<std::size_t>(i)];
    const bool is_removed = std::isfinite(p.x) && grid.getCentroidIndex(p) < 0;
    EXPECT_EQ(removed.count(i), is_removed ? 1u : 0u);
    expected += is_removed;
  }
  EXPECT_EQ(removed.size(), expected);
}

TEST(AdaptiveVoxelGrid, AveragesAllFieldsUnlessToldNotTo) {
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZRGB>);
  for (int i = 0; i < 8; ++i) {
    pcl::PointXYZRGB p(static_cast<std::uint8_t>(100 + 10 * (i % 2)),
                       50,
                       static_cast<std::uint8_t>(i));
    p.x = 0.1f * static_cast<float>(i);
    cloud->push_back(p);
  }
  AdaptiveVoxelGrid<pcl::PointXYZRGB> grid;
  grid.setInputCloud(cloud);
  grid.setDivisions({1, 1, 1});
  pcl::PointCloud<pcl::PointXYZRGB> output;
  grid.filter(output);
  ASSERT_EQ(output.size(), 1u);
  EXPECT_NEAR(output[0].x, 0.35f, 1e-6f);
  EXPECT_EQ(output[0].r, 105);
  EXPECT_EQ(output[0].g, 50);
  EXPECT_EQ(output[0].b, 3);
  grid.setDownsampleAllData(false);
  grid.filter(output);
  EXPECT_NEAR(output[0].x, 0.35f, 1e-6f);
  EXPECT_EQ(output[0].r, 0);
}

TEST(AdaptiveVoxelGrid, CentroidsOfMillionsOfPointsAreExact) {
  // sums in single precision, as in pcl::CentroidPoint, end at 2^24 steps
  Cloud::Ptr cloud(new Cloud);
  cloud->assign(3000000, pcl::PointXYZ(1.1f, 2.3f, 3.7f));
  Grid grid;
  grid.setInputCloud(cloud);
  Cloud output;
  grid.filter(output);
  ASSERT_EQ(output.size(), 1u);
  EXPECT_NEAR(output[0].x, 1.1f, 1e-6f);
  EXPECT_NEAR(output[0].z, 3.7f, 1e-6f);
}

TEST(AdaptiveVoxelGrid, HandsOnHeaderAndSensorPose) {
  const Cloud::Ptr cloud = randomCloud(1000, 8);
  Grid grid;
  grid.setInputCloud(cloud);
  Cloud output;
  grid.filter(output);
  EXPECT_EQ(output.header.frame_id, "camera");
  EXPECT_EQ(output.header.stamp, 1234u);
  EXPECT_EQ(output.sensor_origin_, cloud->sensor_origin_);
  EXPECT_EQ(output.sensor_orientation_.coeffs(), cloud->sensor_orientation_.coeffs());
  EXPECT_EQ(output.width, output.size());
  EXPECT_EQ(output.height, 1u);
  EXPECT_TRUE(output.is_dense);
}

TEST(AdaptiveVoxelGrid, OutputMayBeTheInput) {
  const Cloud::Ptr cloud = randomCloud(1000, 8);
  Grid grid;
  grid.setInputCloud(cloud);
  Cloud expected;
  grid.filter(expected);
  grid.filter(*cloud);
  EXPECT_EQ(cloud->size(), expected.size());
}

TEST(AdaptiveVoxelGrid, TooManyVoxelsAreAnErrorWithAnEmptyOutput) {
  const Quiet quiet;
  Grid grid;
  grid.setInputCloud(randomCloud(1000, 9));
  grid.setPercent({0.01, 0.01, 0.01}); // 1e12 cells
  Cloud output = *randomCloud(10, 1);
  grid.filter(output);
  EXPECT_TRUE(output.empty());
  EXPECT_TRUE(grid.getVoxelLayout().empty());
  EXPECT_EQ(grid.getCentroidIndex({0, 0, 0}), -1);
}

TEST(AdaptiveVoxelGrid, HopelessCloudsGiveAnEmptyOutput) {
  const Quiet quiet;
  Cloud::Ptr cloud(new Cloud);
  Grid grid;
  const auto isEmptyFor = [&] {
    grid.setInputCloud(cloud);
    Cloud output = *randomCloud(10, 1);
    grid.filter(output);
    return output.empty();
  };
  EXPECT_TRUE(isEmptyFor());
  cloud->assign(100, pcl::PointXYZ(0, NOT_A_NUMBER, 0));
  EXPECT_TRUE(isEmptyFor());
  cloud->assign(1, pcl::PointXYZ(1, 2, 3));
  EXPECT_TRUE(isEmptyFor()) << "one point is noise";
  cloud = randomCloud(100, 1);
  cloud->push_back({1e30f, 0, 0});
  EXPECT_TRUE(isEmptyFor()) << "all other points would fall into one voxel";
  grid.setRegion({{-1, -1, -1}, {1, 1, 1}});
  EXPECT_FALSE(isEmptyFor()) << "a region leaves the outlier out";
  grid.setRegion({{5, 5, 5}, {6, 6, 6}});
  EXPECT_TRUE(isEmptyFor()) << "region outside of the cloud";
}

TEST(AdaptiveVoxelGrid, FlatLineAndPointCloudsHaveVoxels) {
  Cloud::Ptr cloud = randomCloud(2000, 1);
  Grid grid;
  grid.setInputCloud(cloud);
  Cloud output;
  for (int axis = 2; axis >= 0; --axis) {
    for (auto& p : *cloud)
      p.data[axis] = 0.5f;
    grid.filter(output);
    EXPECT_FALSE(output.empty());
    EXPECT_EQ(grid.getNrDivisions()[axis], 1);
  }
  EXPECT_EQ(output.size(), 1u);
}

TEST(AdaptiveVoxelGrid, RefusesBadSettingsAndKeepsTheOldOnes) {
  const Quiet quiet;
  Grid grid;
  grid.setPercent({10, 20, 30});
  grid.setPercent({10, 0, 30});
  EXPECT_EQ(grid.getOptions().percent, Eigen::Vector3d(10, 20, 30));
  grid.setTargetSize(-1.0);
  grid.setDivisions({1, 2, 0});
  EXPECT_EQ(grid.getOptions().rule, VoxelRule::PERCENT);
  grid.setTargetSize(0.02, 5, 50);
  EXPECT_EQ(grid.getOptions().rule, VoxelRule::TARGET_SIZE_CLAMPED);
  VoxelOptions options;
  options.max_cells = 0;
  grid.setOptions(options);
  EXPECT_EQ(grid.getOptions().max_cells, VoxelOptions().max_cells);
  grid.setRegion({{1, 0, 0}, {0, 1, 1}});
  EXPECT_FALSE(grid.hasRegion());
  grid.setRegion({{0, 0, 0}, {1, 1, 1}});
  grid.setRegion({{0, 0, 0}, {1, std::nan(""), 1}});
  EXPECT_EQ(grid.getRegion().max, Eigen::Vector3d(1, 1, 1));
  grid.unsetRegion();
  EXPECT_FALSE(grid.hasRegion());
}

TEST(AdaptiveVoxelGrid, LooksUpCentroidsAsPclVoxelGridDoes) {
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 4; ++i) {
    cloud->push_back({0.0f, 0.0f, 0.0f});
    cloud->push_back({1.0f, 1.0f, 1.0f});
  }
  Grid grid;
  EXPECT_EQ(grid.getCentroidIndexAt({0, 0, 0}), -1) << "before filter()";
  EXPECT_EQ(grid.getGridCoordinates(0, 0, 0), Eigen::Vector3i(-1, -1, -1));
  grid.setInputCloud(cloud);
  grid.setDivisions({2, 3, 4});
  Cloud output;
  grid.filter(output);
  ASSERT_EQ(output.size(), 2u);
  EXPECT_EQ(grid.getGridCoordinates(0, 0, 0), Eigen::Vector3i(0, 0, 0));
  EXPECT_EQ(grid.getGridCoordinates(1, 1, 1), Eigen::Vector3i(1, 2, 3));
  EXPECT_EQ(grid.getGridCoordinates(2, 1, 1), Eigen::Vector3i(-1, -1, -1));
  EXPECT_EQ(grid.getCentroidIndexAt({0, 0, 0}), 0);
  EXPECT_EQ(grid.getCentroidIndexAt({1, 2, 3}), 1);
  EXPECT_EQ(grid.getCentroidIndexAt({1, 1, 1}), -1);
  EXPECT_EQ(grid.getCentroidIndexAt({2, 0, 0}), -1);
  EXPECT_EQ(grid.getCentroidIndexAt({-1, 0, 0}), -1);
  EXPECT_EQ(grid.getLeafLayout().size(), 24u);
}
