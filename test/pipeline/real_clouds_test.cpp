// SPDX-License-Identifier: BSD-3-Clause
// The paper's mode on real clouds of stereo and depth cameras; skipped where they are
// not.
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/tabletop_segmentation.h"

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace pcl_sq;

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief The cloud, or null where the data are not there. */
Cloud::Ptr load(const std::string& name) {
  const std::string path = std::string(PCL_SQ_TEST_DATA) + "/clouds/" + name;
  auto cloud = pcl::make_shared<Cloud>();
  if (!std::filesystem::exists(path) || pcl::io::loadPCDFile(path, *cloud) != 0)
    return nullptr;
  return cloud;
}

#define LOAD_OR_SKIP(cloud, name)                                                      \
  const Cloud::Ptr cloud = load(name);                                                 \
  if (!cloud)                                                                          \
  GTEST_SKIP() << "set PCL_SQ_TEST_DATA to the folder that holds clouds/" << (name)

MultiSuperquadric estimate(const Cloud::Ptr& cloud, const pcl::IndicesPtr& object) {
  ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(cloud);
  if (object)
    estimation.setIndices(object);
  MultiSuperquadric model;
  EXPECT_TRUE(estimation.estimate(model)) << estimation.getReport().failure;
  for (const Superquadric& part : model.parts)
    EXPECT_TRUE(part.isValid());
  return model;
}

} // namespace

TEST(RealClouds, MugOfTheStereoSceneBecomesBodyAndHandle) {
  LOAD_OR_SKIP(cloud, "pcl/table_scene_mug_stereo_textured.pcd");
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(cloud);
  const pcl::IndicesPtr object(new pcl::Indices);
  ASSERT_TRUE(tabletop.segment(*object)) << tabletop.getFailure();
  const MultiSuperquadric model = estimate(cloud, object);
  ASSERT_GE(model.size(), 2u);
  // the handle is small, seen from the camera: across by along, the depth being a guess
  const auto size = [](const Superquadric& part) {
    const Eigen::Vector3d sides = part.halfSizes();
    return sides.x() * sides.y();
  };
  double largest = 0.0, smallest = 1.0;
  for (const Superquadric& part : model.parts) {
    largest = std::max(largest, size(part));
    smallest = std::min(smallest, size(part));
  }
  EXPECT_LT(smallest, 0.3 * largest) << model;
}

TEST(RealClouds, HandleOfTheBlueMugIsABentRodAsThickAsItsArms) {
  LOAD_OR_SKIP(cloud, "rgbd_blue_mug/cloud.pcd");
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(cloud);
  const pcl::IndicesPtr object(new pcl::Indices);
  ASSERT_TRUE(tabletop.segment(*object)) << tabletop.getFailure();
  const auto outside = [&](int i) { // of a box drawn by hand
    const int x = i % int(cloud->width), y = i / int(cloud->width);
    return x < 266 || x >= 422 || y < 162 || y >= 325;
  };
  object->erase(std::remove_if(object->begin(), object->end(), outside), object->end());
  const MultiSuperquadric model = estimate(cloud, object);
  // about 12 mm thick, its arc about 25 mm from the hole's middle
  const auto handle = std::find_if(model.parts.begin(),
                                   model.parts.end(),
                                   [](const Superquadric& s) { return s.isBent(); });
  ASSERT_NE(handle, model.parts.end()) << model;
  EXPECT_NEAR(handle->semi_axes.x(), 0.006, 0.002) << model;
  EXPECT_NEAR(1.0 / std::abs(handle->bend), 0.025, 0.008) << model;
}

TEST(RealClouds, MilkCartonHasItsSizeWithinTheVisibleSide) {
  LOAD_OR_SKIP(cloud, "pcl/milk.pcd");
  const MultiSuperquadric model = estimate(cloud, nullptr);
  const double height = model.boundingBox().sizes().y();
  EXPECT_GT(height, 0.2);
  EXPECT_LT(height, 0.32);
}

TEST(RealClouds, SprayCanLidAndPartialViewsGiveModels) {
  for (const char* name : {"gpd/krylon.pcd",
                           "find_superquadric/box.pcd",
                           "find_superquadric/cylinder.pcd",
                           "rgbd_blue_mug/object.pcd",
                           "rgbd_mustard/object.pcd",
                           "rgbd_cheezit/object.pcd"}) {
    LOAD_OR_SKIP(cloud, name);
    EXPECT_GE(estimate(cloud, nullptr).size(), 1u) << name;
  }
}

TEST(RealClouds, ApertureOfARegionKeepsTheObjectAndLeavesTheBackground) {
  LOAD_OR_SKIP(cloud, "rgbd_cheezit/cloud.pcd");
  RoiEstimator<pcl::PointXYZ> estimator;
  estimator.setInputCloud(cloud);
  estimator.setRect({344, 47, 169, 281});
  RoiBox region;
  pcl::IndicesPtr object(new pcl::Indices);
  ASSERT_TRUE(estimator.estimate(region, *object));
  EXPECT_LT(region.sizes().z(), 0.4);
  const MultiSuperquadric model = estimate(cloud, object);
  // 64 x 159 x 211 mm, and some table at its foot
  EXPECT_GT(model.boundingBox().sizes().maxCoeff(), 0.17);
  EXPECT_LT(model.boundingBox().sizes().maxCoeff(), 0.35);
}
