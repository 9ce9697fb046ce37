// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/prism_segmentation.h"

#include "pcl_sq/adaptive_voxel_grid.h"

#include "clouds.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

namespace {

/** A flat bottle: body 0.2 x 0.3 m below (y points down), neck 0.06 x 0.1 m on top. */
Cloud::Ptr bottleCloud() {
  const Cloud::Ptr body = randomCloud(6000, 1, 0.0f, 0.0f, 0.0f, 1.0f);
  const Cloud::Ptr neck = randomCloud(2000, 2, 0.0f, 0.0f, 0.0f, 1.0f);
  Cloud::Ptr cloud(new Cloud);
  cloud->header = body->header;
  for (const auto& p : *body)
    cloud->push_back({0.2f * p.x, 0.1f + 0.3f * p.y, 1.0f + 0.02f * p.z});
  for (const auto& p : *neck)
    cloud->push_back({0.07f + 0.06f * p.x, 0.1f * p.y, 1.0f + 0.02f * p.z});
  return cloud;
}

VoxelLayout layoutOf(const Cloud::Ptr& cloud) {
  AdaptiveVoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  Cloud voxels;
  grid.filter(voxels);
  return grid.getVoxelLayout();
}

PrismOptions figure4() {
  PrismOptions options;
  options.method = PrismMethod::FIGURE_4;
  return options;
}

class PrismSegmentationTest : public testing::Test {
protected:
  PrismSegmentationTest() : cloud(bottleCloud()) {
    segmentation.setInputCloud(cloud);
    segmentation.setVoxelLayout(layoutOf(cloud));
  }
  Cloud::Ptr cloud;
  PrismSegmentation<pcl::PointXYZ> segmentation;
  std::vector<pcl::PointIndices> clusters;
};

} // namespace

TEST_F(PrismSegmentationTest, SplitsABottleIntoBodyAndNeck) {
  ASSERT_TRUE(segmentation.segment(clusters));
  ASSERT_EQ(clusters.size(), 2u);
  ASSERT_EQ(segmentation.getPrisms().size(), 2u);
  // body first; one row of voxels may lie across the shoulder
  EXPECT_NEAR(static_cast<double>(clusters[0].indices.size()), 6000.0, 450.0);
  EXPECT_NEAR(static_cast<double>(clusters[1].indices.size()), 2000.0, 450.0);
}

TEST_F(PrismSegmentationTest, EachPointIsInTheBoxOfItsPrism) {
  ASSERT_TRUE(segmentation.segment(clusters));
  for (std::size_t p = 0; p < clusters.size(); ++p) {
    RoiBox box = segmentation.getPrisms()[p].box;
    box.min.array() -= 1e-9;
    box.max.array() += 1e-9;
    for (const int i : clusters[p].indices)
      EXPECT_TRUE(box.contains(
          (*cloud)[static_cast<std::size_t>(i)].getVector3fMap().cast<double>()));
  }
}

TEST_F(PrismSegmentationTest, ClustersHoldIndicesOfTheCloudInTheOrderGiven) {
  const pcl::IndicesPtr indices = someIndices(cloud->size());
  segmentation.setIndices(indices);
  ASSERT_TRUE(segmentation.segment(clusters));
  std::size_t members = 0;
  for (const pcl::PointIndices& cluster : clusters) {
    members += cluster.indices.size();
    EXPECT_TRUE(std::is_sorted(cluster.indices.rbegin(), cluster.indices.rend()));
    for (const int i : cluster.indices)
      EXPECT_EQ(i % 3, static_cast<int>(cloud->size() - 1) % 3);
    EXPECT_EQ(cluster.header.frame_id, "camera");
  }
  EXPECT_GE(members, indices->size() - 20);
}

TEST_F(PrismSegmentationTest, PointsInSeveralPrismsAreSharedOrGoToTheSmallest) {
  segmentation.setOptions(figure4()); // the neck runs through the body
  ASSERT_TRUE(segmentation.segment(clusters));
  ASSERT_EQ(clusters.size(), 2u);
  const std::size_t shared = clusters[0].indices.size() + clusters[1].indices.size();
  EXPECT_GT(shared, cloud->size() + 1000);
  segmentation.setExclusive(true);
  ASSERT_TRUE(segmentation.segment(clusters));
  ASSERT_EQ(clusters.size(), 2u);
  pcl::Indices all = clusters[0].indices;
  all.insert(all.end(), clusters[1].indices.begin(), clusters[1].indices.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  EXPECT_GT(all.size(), cloud->size() - 20);
  const auto& prisms = segmentation.getPrisms();
  const std::size_t smaller = prisms[0].cells.area() < prisms[1].cells.area() ? 0 : 1;
  std::size_t in_smaller = 0;
  for (const auto& p : *cloud)
    in_smaller += prisms[smaller].box.contains(p.getVector3fMap().cast<double>());
  EXPECT_NEAR(static_cast<double>(clusters[smaller].indices.size()),
              static_cast<double>(in_smaller),
              20.0);
}

TEST_F(PrismSegmentationTest, PointsOfInvalidVoxelsAreInNoPrism) {
  VoxelLayout layout = segmentation.getVoxelLayout();
  const pcl::PointXYZ& p = cloud->front();
  const std::int32_t voxel = layout.indexOf(p.x, p.y, p.z);
  layout.counts[static_cast<std::size_t>(voxel)] = 0;
  segmentation.setVoxelLayout(layout);
  ASSERT_TRUE(segmentation.segment(clusters));
  for (const pcl::PointIndices& cluster : clusters)
    for (const int i : cluster.indices) {
      const pcl::PointXYZ& q = (*cloud)[static_cast<std::size_t>(i)];
      EXPECT_NE(layout.indexOf(q.x, q.y, q.z), voxel);
    }
}

TEST_F(PrismSegmentationTest, PointsThatAreNotFiniteAreInNoPrism) {
  cloud->push_back({NOT_A_NUMBER, 0.2f, 1.0f});
  cloud->push_back({0.1f, 0.2f, 1e30f});
  cloud->is_dense = true; // not true, and must not matter
  const int first_bad = static_cast<int>(cloud->size()) - 2;
  ASSERT_TRUE(segmentation.segment(clusters));
  for (const pcl::PointIndices& cluster : clusters)
    for (const int i : cluster.indices)
      EXPECT_LT(i, first_bad);
}

TEST_F(PrismSegmentationTest, DropsPrismsWithFewPointsAmongTheIndices) {
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 0; i < 6029; ++i) // 29 of the neck; the layout saw 2000
    indices->push_back(i);
  segmentation.setIndices(indices);
  ASSERT_TRUE(segmentation.segment(clusters));
  EXPECT_EQ(clusters.size(), 1u);
  EXPECT_EQ(segmentation.getPrisms().size(), 1u);
}

TEST_F(PrismSegmentationTest, FailsWithoutAGridOrPoints) {
  const Quiet quiet;
  clusters.resize(3);
  segmentation.setVoxelLayout(VoxelLayout());
  EXPECT_FALSE(segmentation.segment(clusters));
  EXPECT_TRUE(clusters.empty());
  PrismSegmentation<pcl::PointXYZ> unset;
  clusters.resize(3);
  EXPECT_FALSE(unset.segment(clusters));
  EXPECT_TRUE(clusters.empty());
  for (const std::size_t count : {0u, 1u, 29u}) {
    Cloud::Ptr few(new Cloud);
    few->assign(count, pcl::PointXYZ(0.1f, 0.2f, 1.01f));
    segmentation.setVoxelLayout(layoutOf(bottleCloud()));
    segmentation.setInputCloud(few);
    clusters.resize(3);
    EXPECT_FALSE(segmentation.segment(clusters)) << count;
    EXPECT_TRUE(clusters.empty());
    EXPECT_TRUE(segmentation.getPrisms().empty());
  }
}

TEST_F(PrismSegmentationTest, RefusesAGridThatIsTooFine) {
  const Quiet quiet;
  VoxelOptions options;
  options.rule = VoxelRule::DIVISIONS;
  options.divisions = {MAX_PRISM_CELLS + 1, MAX_PRISM_CELLS + 1, 1};
  VoxelLayout layout;
  ASSERT_TRUE(makeVoxelLayout({{0, 0, 0}, {1, 1, 1}}, options, layout));
  segmentation.setVoxelLayout(layout);
  EXPECT_FALSE(segmentation.segment(clusters));
}

TEST_F(PrismSegmentationTest, RefusesBadOptionsAndKeepsTheOldOnes) {
  const Quiet quiet;
  PrismOptions options;
  options.min_points = 7;
  segmentation.setOptions(options);
  options.min_points = -1;
  segmentation.setOptions(options);
  EXPECT_EQ(segmentation.getOptions().min_points, 7);
}
