// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/tabletop_segmentation.h"

#include "bottle_view.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A table below (y down), the bottle and a smaller box on it, a wall behind. */
struct BottleOnTable {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud =
      pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::Indices bottle_indices;
};

BottleOnTable tableScene() {
  BottleOnTable seen;
  Random random(50);
  const auto add = [&](double x, double y, double z) {
    seen.cloud->push_back(
        pcl::PointXYZ(float(x), float(y + random.normal(0.0005)), float(z)));
  };
  const double nan = std::nan("");
  for (int i = 0; i < 20000; ++i)
    add(random.uniform(-0.4, 0.4), 0.15, random.uniform(0.6, 1.2));
  for (int i = 0; i < 3000; ++i)
    add(random.uniform(-0.4, 0.4), random.uniform(-1.0, 0.1), 2.0);
  add(nan, nan, nan);
  for (int i = 0; i < 1500; ++i)
    add(-0.2 + random.uniform(0, 0.05), random.uniform(0.1, 0.149), 0.8);
  const Eigen::Matrix3Xd object = visiblePoints(bottle(), 6000);
  for (Eigen::Index i = 0; i < object.cols(); ++i) {
    seen.bottle_indices.push_back(int(seen.cloud->size()));
    add(object(0, i), object(1, i), object(2, i));
  }
  return seen;
}

} // namespace

TEST(TabletopSegmentation, FindsTheLargestObjectOnTheLargestPlane) {
  const BottleOnTable seen = tableScene();
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(seen.cloud);
  pcl::Indices object;
  ASSERT_TRUE(tabletop.segment(object)) << tabletop.getFailure();
  EXPECT_NEAR(tabletop.getPlane().normal.y(), -1.0, 1e-3); // towards the camera
  EXPECT_NEAR(tabletop.getPlane().signedDistance({0.0, 0.15, 0.9}), 0.0, 2e-3);
  // the object but for a strip at the table's height, and nothing else
  EXPECT_GT(object.size(), 0.9 * seen.bottle_indices.size());
  for (const auto index : object)
    EXPECT_GE(index, seen.bottle_indices.front());
}

TEST(TabletopSegmentation, WorksOnGivenIndicesAlone) {
  const BottleOnTable seen = tableScene();
  auto indices = pcl::make_shared<pcl::Indices>(); // without the bottle
  for (int i = 0; i < seen.bottle_indices.front(); ++i)
    indices->push_back(i);
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(seen.cloud);
  tabletop.setIndices(indices);
  pcl::Indices object;
  ASSERT_TRUE(tabletop.segment(object));
  for (const auto index : object) // the small box
    EXPECT_LT((*seen.cloud)[index].x, -0.1f);
}

TEST(TabletopSegmentation, SaysWhyThereIsNoObject) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  pcl::Indices object{1, 2, 3};
  tabletop.setInputCloud(cloud);
  EXPECT_FALSE(tabletop.segment(object));
  EXPECT_TRUE(object.empty());
  Random random(51);
  for (int i = 0; i < 5000; ++i)
    cloud->push_back(
        pcl::PointXYZ(float(random.uniform(0, 1)), float(random.uniform(0, 1)), 1.0f));
  tabletop.setInputCloud(cloud); // an empty table
  EXPECT_FALSE(tabletop.segment(object));
  EXPECT_NE(tabletop.getFailure().find("nothing"), std::string::npos);
  for (auto& p : *cloud) // a ball of points: no plane
    p.getVector3fMap() = (random.direction() * random.uniform(0, 1)).cast<float>();
  EXPECT_FALSE(tabletop.segment(object));
  TabletopOptions options;
  options.cluster_gap = -1.0;
  tabletop.setOptions(options);
  EXPECT_EQ(tabletop.getOptions().cluster_gap, 0.0);
}
