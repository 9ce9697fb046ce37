// SPDX-License-Identifier: BSD-3-Clause
// Which plane is the table, where it ends, and what beside a thing is still the table.
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A wider view than fineScene()'s: what is beside the table is seen. */
TableScene wideScene() {
  TableScene scene = fineScene();
  scene.camera.fx = scene.camera.fy = 300.0;
  return scene;
}

double heightOfCamera(const TablePlane& table) {
  return table.signedDistance(Eigen::Vector3d::Zero());
}

} // namespace

TEST(SceneTable, OfATableAndItsFloorIsTheOneThatThingsStandOn) {
  TableScene truth = wideScene();
  truth.half_table = {0.2, 0.14};
  truth.floor = 0.3;
  truth.can({-0.1, 0.0}).can({0.08, 0.02});
  // a foot of something on the floor, large in the image
  truth.stand({0.42, 0.1}, {0.05, 0.05, 0.1}, 0.1, 0.1);
  truth.things.back().center.z() -= truth.floor;
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  ASSERT_TRUE(scene.table) << scene.failure;
  EXPECT_NEAR(heightOfCamera(*scene.table), truth.camera.center.z(), 0.01);
  EXPECT_EQ(scene.objects.size(), 2u);
}

TEST(SceneTable, WhatTouchesAWallThatTheImageCutsIsAThing) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.12}, {0.6, 0.02, 0.2}, 0.1, 0.1).can({0.0, 0.06});
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true));
  ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
  EXPECT_NEAR(scene.objects[0].model.boundingBox().sizes().x(), 0.066, 0.01);
}

TEST(SceneTable, TheFootOfAWallThatIsLeftOutIsNoThings) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.12}, {0.6, 0.02, 0.2}, 0.1, 0.1).can({0.0, 0.02});
  const auto cloud = cloudOf(truth, truth.inCamera(), true);
  const LabelImage labels = truthOf(truth);
  for (std::size_t c = 2; c + 2 < labels.values.size(); ++c)
    if (labels.values[c] == 2 &&
        (labels.values[c - 2] == 1 || labels.values[c + 2] == 1))
      (*cloud)[c].rgba = (*cloud)[c + (labels.values[c - 2] == 1 ? -2 : 2)].rgba;
  const Scene scene = estimate(cloud);
  ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
  int wall = 0, own = 0;
  for (std::size_t c = 0; c < labels.values.size(); ++c)
    if (scene.labels.values[c] > 0)
      ++(labels.values[c] == 1 ? wall : own);
  EXPECT_LT(wall, own / 50);
}

TEST(SceneTable, WhatHasTheTablesColorBesideAThingIsTheSensorsHalo) {
  TableScene truth = fineScene();
  truth.can({0.0, 0.02});
  Eigen::Matrix3Xf points = truth.inCamera();
  const auto cloud = cloudOf(truth, points, true);
  const LabelImage labels = truthOf(truth);
  constexpr int HALO = 6; // pixels to the right of the can get its depth
  for (int y = 0; y < truth.height; ++y)
    for (int x = truth.width - 1; x >= HALO; --x) {
      const int c = y * truth.width + x;
      int near = 1;
      while (near <= HALO && labels.values[std::size_t(c - near)] == 0)
        ++near;
      if (labels.values[std::size_t(c)] > 0 || near > HALO)
        continue;
      const float depth = points(2, c - near);
      (*cloud)[std::size_t(c)].getVector3fMap() = points.col(c) * depth / points(2, c);
    }
  const Scene scene = estimate(cloud);
  ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
  int halo = 0, own = 0;
  for (std::size_t c = 0; c < labels.values.size(); ++c)
    if (scene.labels.values[c] > 0)
      ++(labels.values[c] > 0 ? own : halo);
  EXPECT_LT(halo, own / 50);
}
