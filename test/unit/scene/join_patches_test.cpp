// SPDX-License-Identifier: BSD-3-Clause
// What is one thing, although something parts it, and what is two, although one carries
// the other or looks like it.
#include "patches/patches.h"

#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(JoinPatches, WhatAnotherThingHidesTheMiddleOfIsOneThing) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.07}, {0.09, 0.02, 0.03}, 0.1, 0.1)
      .stand({0.0, -0.02}, {0.03, 0.02, 0.06}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  ASSERT_EQ(scene.objects.size(), 2u) << scene.failure;
  double widest = 0.0;
  for (const SceneObject& object : scene.objects)
    widest = std::max(widest, object.model.boundingBox().sizes().x());
  EXPECT_NEAR(widest, 0.18, 0.02);
}

TEST(JoinPatches, ThingsOfOneColorWithTheTableBetweenThemAreTwo) {
  TableScene truth = fineScene();
  truth.can({-0.05, 0.02}).can({0.05, 0.02});
  auto cloud = cloudOf(truth, truth.inCamera(), true);
  const LabelImage labels = truthOf(truth);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (labels.values[i] > 0) {
      (*cloud)[i].r = 200;
      (*cloud)[i].g = 60;
      (*cloud)[i].b = 50;
    }
  EXPECT_EQ(estimate(cloud).objects.size(), 2u);
}

TEST(JoinPatches, WhatStandsOnALedgeIsAThingOfItsOwn) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.0}, {0.07, 0.06, 0.03}, 0.1, 0.1).can({0.0, 0.0});
  truth.things[1].semi_axes = {0.025, 0.025, 0.035};
  truth.things[1].center.z() = 0.06 + 0.035;
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  EXPECT_EQ(scene.objects.size(), 2u) << scene.failure;
}

TEST(JoinPatches, WhatGoesOnAboveALabelIsOneThing) {
  TableScene truth = fineScene();
  truth.can().stand({0.0, 0.0}, {0.032, 0.032, 0.07}, 1.0, 1.0); // shoulders
  truth.things[1].center.z() = 0.12;
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  EXPECT_EQ(scene.objects.size(), 1u) << scene.failure;
}

TEST(JoinPatches, APotWhoseInsideHasAnotherColourIsOneThing) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.0}, {0.07, 0.07, 0.05}, 0.1, 1.0);
  truth.things[0].rim = 0.9;
  truth.things[0].wall = 0.004;
  auto cloud = cloudOf(truth, truth.inCamera(), true);
  const LabelImage labels = truthOf(truth);
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      const int i = y * truth.width + x;
      if (labels.values[std::size_t(i)] == 0)
        continue;
      const Eigen::Vector3d at =
          truth.camera.center +
          truth.camera.rotation *
              (*cloud)[std::size_t(i)].getVector3fMap().cast<double>();
      if (at.head<2>().norm() < 0.068) { // the light falls into it
        (*cloud)[std::size_t(i)].r = 200;
        (*cloud)[std::size_t(i)].g = 120;
        (*cloud)[std::size_t(i)].b = 50;
      }
    }
  const Scene scene = estimate(cloud);
  EXPECT_EQ(scene.objects.size(), 1u) << scene.failure;
}

TEST(JoinPatches, WhatLooksOverAThingFromBehindIsAThingOfItsOwn) {
  TableScene truth = fineScene();
  truth.stand({0.0, -0.02}, {0.05, 0.02, 0.08}, 0.1, 0.1)
      .stand({0.0, 0.08}, {0.045, 0.02, 0.09}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  EXPECT_EQ(scene.objects.size(), 2u) << scene.failure;
}

TEST(JoinPatches, WhatHidesTheMiddleOfABentThingNeedNotReachOverItsEnds) {
  constexpr int WIDTH = 60, HEIGHT = 40;
  Eigen::Matrix3Xf points(3, WIDTH * HEIGHT);
  const detail::ColorMatrix colors = detail::ColorMatrix::Zero(3, WIDTH * HEIGHT);
  detail::Patch left, right;
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const bool before = x >= 25 && x < 36 && y >= 12;
      const bool end = y >= 5 && y < 30 && std::abs(std::abs(x - 30) - 8) < 3;
      const float z = before ? 0.5F : end ? 0.8F : 2.0F;
      points.col(y * WIDTH + x) << 0.01F * float(x - 30) * z, 0.01F * float(y) * z, z;
      if (end)
        (x < 30 ? left : right).pixels.push_back(y * WIDTH + x);
    }
  left.high = right.high = 1.0;
  TableModel table;
  table.normal = -Eigen::Vector3d::UnitY();
  table.offset = 1.0;
  const detail::SceneView view{
      CloudPoints(points), WIDTH, HEIGHT, colors, PinholeCamera(), table};
  const detail::Between gap = detail::between(view, left, right);
  EXPECT_TRUE(gap.hidden);
  EXPECT_FALSE(gap.background);
  EXPECT_TRUE(gap.apart_above);
}

TEST(JoinPatches, AFlyingPixelOfAThingsColorIsNotItsOutline) {
  constexpr int WIDTH = 60, HEIGHT = 40;
  std::vector<int> pixels = {3 * WIDTH + 50};
  int handle = 0;
  for (int y = 10; y < 30; ++y)
    for (int x = 5; x < 40; ++x)
      if (const bool apart = x >= 33; x < 30 || (apart && y < 18)) {
        pixels.push_back(y * WIDTH + x);
        handle += apart;
      }
  ASSERT_GT(handle, 20);
  const std::vector<int> kept = detail::withoutStrays(pixels, WIDTH, HEIGHT);
  EXPECT_EQ(kept.size(), pixels.size() - 1);
  EXPECT_EQ(std::count(kept.begin(), kept.end(), pixels.front()), 0);
}
