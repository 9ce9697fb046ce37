// SPDX-License-Identifier: BSD-3-Clause
// All things on a table: told apart, each its own model, none of another's outline.
#include "pcl_sq/scene_estimation.h"

#include "seen_scene.h"

#include <pcl/common/io.h>

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

TableScene threeThings() {
  TableScene scene = fineScene();
  scene.can({-0.09, 0.02})
      .stand({0.08, 0.03}, {0.03, 0.045, 0.04}, 0.1, 0.1, 0.4)
      .stand({-0.005, -0.05}, {0.03, 0.03, 0.03}, 1.0, 1.0);
  return scene;
}

} // namespace

TEST(SceneEstimation, FindsEveryThingOnTheTable) {
  const TableScene truth = threeThings();
  for (const bool colored : {false, true}) {
    const Scene scene = estimate(cloudOf(truth, truth.inCamera(), colored));
    ASSERT_EQ(scene.objects.size(), 3u) << scene.failure;
    ASSERT_TRUE(scene.table);
    EXPECT_LT(farthest(scene, truth, truth.camera), 0.012);
    for (const SceneObject& object : scene.objects) {
      EXPECT_GT(object.report.confidence, 0.8);
      EXPECT_GT(object.visible, 0.8);
      EXPECT_GT(object.pixels, 500);
    }
    // from left to right
    EXPECT_LT(scene.objects[0].roi.x, scene.objects[1].roi.x);
    EXPECT_LT(scene.objects[1].roi.x, scene.objects[2].roi.x);
  }
}

TEST(SceneEstimation, AThingOfTheTablesColorKeepsAllItsPixels) {
  TableScene truth = fineScene();
  truth.can();
  const auto expectAll = [&truth](const auto& cloud) {
    const Scene scene = estimate(cloud);
    const LabelImage labels = truthOf(truth);
    int both = 0, any = 0;
    for (std::size_t i = 0; i < labels.values.size(); ++i) {
      both += labels.values[i] > 0 && scene.labels.values[i] > 0;
      any += labels.values[i] > 0 || scene.labels.values[i] > 0;
    }
    EXPECT_GT(both, 0.95 * any) << truth.noise;
  };
  for (const double noise : {0.0, 0.001}) {
    truth.noise = noise;
    const auto cloud = cloudOf(truth, truth.inCamera(), false);
    expectAll(cloud);
    for (std::size_t i = 0; i < cloud->size(); i += 97) // the sensor misses some
      (*cloud)[i].x = (*cloud)[i].y = (*cloud)[i].z =
          std::numeric_limits<float>::quiet_NaN();
    expectAll(cloud);
  }
}

TEST(SceneEstimation, ACloudWithoutColorsIsAsOneOfOneColor) {
  const TableScene truth = threeThings();
  const auto cloud = cloudOf(truth, truth.inCamera(), false);
  const auto bare = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::copyPointCloud(*cloud, *bare);
  SceneEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud(bare);
  Scene scene;
  ASSERT_TRUE(estimation.estimate(scene));
  EXPECT_EQ(scene.labels.values, estimate(cloud).labels.values);
  EXPECT_EQ(scene.objects.size(), 3u);
}

TEST(SceneEstimation, GivesTheSameInTheRobotsFrame) {
  const TableScene truth = threeThings();
  const Scene scene = estimate(cloudOf(truth, truth.inRoom(), true));
  ASSERT_EQ(scene.objects.size(), 3u) << scene.failure;
  EXPECT_LT(farthest(scene, truth, {}), 0.012);
  EXPECT_GT(scene.table->normal.z(), 0.999);
}

TEST(SceneEstimation, GivesTheSameForAnyNumberOfThreads) {
  const TableScene truth = threeThings();
  const auto cloud = cloudOf(truth, truth.inCamera(), true);
  const Scene one = estimate(cloud, {}, 1), three = estimate(cloud, {}, 3);
  ASSERT_EQ(one.objects.size(), three.objects.size());
  EXPECT_EQ(one.labels.values, three.labels.values);
  for (std::size_t k = 0; k < one.objects.size(); ++k) {
    ASSERT_EQ(one.objects[k].model.size(), three.objects[k].model.size());
    EXPECT_EQ(one.objects[k].model.parts[0].semi_axes,
              three.objects[k].model.parts[0].semi_axes);
  }
}

TEST(SceneEstimation, TellsTouchingThingsOfTwoColorsApart) {
  TableScene truth = fineScene();
  truth.stand({-0.0305, 0.0}, {0.03, 0.03, 0.05}, 0.1, 0.1)
      .stand({0.0405, 0.0}, {0.04, 0.03, 0.03}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  ASSERT_EQ(scene.objects.size(), 2u) << scene.failure;
  EXPECT_LT(farthest(scene, truth, truth.camera), 0.015);
}

TEST(SceneEstimation, LeavesABodyOfTwoColorsWhole) {
  TableScene truth = fineScene();
  truth.can();
  auto cloud = cloudOf(truth, truth.inCamera(), true);
  const LabelImage labels = truthOf(truth);
  // a label around the can's lower half
  for (int y = truth.height / 2 + 10; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x)
      if (const int i = y * truth.width + x; labels.values[std::size_t(i)] > 0) {
        (*cloud)[std::size_t(i)].r = 40;
        (*cloud)[std::size_t(i)].g = 80;
        (*cloud)[std::size_t(i)].b = 200;
      }
  const Scene scene = estimate(cloud);
  EXPECT_EQ(scene.objects.size(), 1u) << scene.failure;
}

TEST(SceneEstimation, UsesLabelsAsTheyAre) {
  const TableScene truth = threeThings();
  LabelImage labels = truthOf(truth);
  for (std::uint16_t& label : labels.values)
    label = std::uint16_t(label == 1 ? 700 : label == 2 ? 0 : label);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), labels);
  ASSERT_EQ(scene.objects.size(), 2u) << scene.failure;
  EXPECT_EQ(scene.labels.values, labels.values);
  EXPECT_EQ(scene.objects[0].label, 700);
  EXPECT_EQ(scene.objects[1].label, 3);
  EXPECT_EQ(scene.objects[0].pixels,
            std::count(labels.values.begin(), labels.values.end(), 700));
}

TEST(SceneEstimation, WhatAnotherThingHidesEndsAtNoOutline) {
  // the can's right half is hidden by a box close before it
  TableScene truth = fineScene();
  truth.can().stand({0.05, -0.065}, {0.045, 0.01, 0.07}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), truthOf(truth));
  ASSERT_EQ(scene.objects.size(), 2u) << scene.failure;
  const SceneObject& can = scene.objects[0];
  EXPECT_LT(can.visible, 0.85);
  EXPECT_GT(scene.objects[1].visible, 0.95);
  // as wide as it is, not as it is seen
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  EXPECT_NEAR(can.model.support(right) + can.model.support(-right), 0.066, 0.012);
  int others = 0;
  for (const ContourPoint& p : can.report.view.contour)
    others += !p.own;
  EXPECT_GT(others, 20);
}

TEST(SceneEstimation, SaysWhyThereIsNoScene) {
  const TableScene truth = threeThings();
  const auto cloud = cloudOf(truth, truth.inCamera(), true);
  EXPECT_NE(estimate(cloud, LabelImage(10, 10)).failure.find("10 x 10"),
            std::string::npos);
  EXPECT_NE(estimate(cloud, LabelImage(truth.width, truth.height))
                .failure.find("mark no thing"),
            std::string::npos);
  auto list = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>(*cloud);
  list->width *= list->height;
  list->height = 1;
  EXPECT_NE(estimate(list).failure.find("list"), std::string::npos);
  const TableScene bare = fineScene();
  EXPECT_NE(estimate(cloudOf(bare, bare.inCamera(), true)).failure, "");
  SceneEstimation<pcl::PointXYZ> without;
  Scene scene;
  EXPECT_FALSE(without.estimate(scene));
  EXPECT_NE(scene.failure.find("setInputCloud"), std::string::npos);
}

TEST(SceneOptions, RefuseWhatAScenesThingsCannotHave) {
  std::string why;
  SceneOptions options;
  EXPECT_TRUE(options.isValid(&why)) << why;
  options.min_pixels = 3;
  EXPECT_FALSE(options.isValid(&why));
  options = {};
  options.estimation.decomposition = Decomposition::PRISMS;
  EXPECT_FALSE(options.isValid(&why));
  options = {};
  options.estimation.view.mask = CellMask(4, 4);
  EXPECT_FALSE(options.isValid(&why));
}
