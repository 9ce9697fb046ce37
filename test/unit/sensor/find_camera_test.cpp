// SPDX-License-Identifier: BSD-3-Clause
// The camera of an organized cloud that lies in any frame.
#include "pcl_sq/object_view.h"

#include "table_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

Eigen::Matrix3Xf moved(const Eigen::Matrix3Xf& points,
                       const Eigen::Matrix3d& rotation,
                       const Eigen::Vector3d& shift) {
  return ((rotation * points.cast<double>()).colwise() + shift).cast<float>();
}

} // namespace

TEST(FindCamera, GivesThePoseOfACloudInAnyFrame) {
  const TableScene scene = TableScene().can();
  const Eigen::Matrix3Xf points = scene.inCamera();
  Random random(1);
  for (int k = 0; k < 5; ++k) {
    const Eigen::Matrix3d rotation = random.rotation();
    const Eigen::Vector3d shift = random.direction() * random.uniform(0, 2);
    PinholeCamera camera;
    ASSERT_TRUE(findCamera(moved(points, rotation, shift),
                           scene.width,
                           scene.height,
                           std::nullopt,
                           camera));
    EXPECT_NEAR((camera.center - shift).norm(), 0.0, 1e-3);
    EXPECT_NEAR((camera.rotation - rotation).norm(), 0.0, 2e-3);
    EXPECT_NEAR(camera.fx, scene.camera.fx, 0.5);
    EXPECT_NEAR(camera.cy, scene.camera.cy, 0.5);
  }
}

TEST(FindCamera, AKnownPlaceMakesAPlaneEnough) {
  TableScene scene; // an empty table without noise: the rays alone leave the place open
  scene.noise = 0.0;
  const Eigen::Matrix3Xf points = scene.inRoom();
  PinholeCamera camera;
  ASSERT_TRUE(
      findCamera(points, scene.width, scene.height, scene.camera.center, camera));
  EXPECT_EQ(camera.center, scene.camera.center);
  EXPECT_NEAR((camera.rotation - scene.camera.rotation).norm(), 0.0, 1e-3);
  EXPECT_NEAR(camera.fx, scene.camera.fx, 0.3);
}

TEST(FindCamera, InItsCamerasFrameItIsWhatFindIntrinsicsGivesToTheBit) {
  const TableScene scene = TableScene().can();
  const Eigen::Matrix3Xf points = scene.inCamera();
  PinholeCamera camera, expected;
  ASSERT_TRUE(findIntrinsics(points, scene.width, scene.height, expected));
  // whatever VIEWPOINT the file tells
  ASSERT_TRUE(
      findCamera(points, scene.width, scene.height, Eigen::Vector3d(1, 2, 3), camera));
  EXPECT_EQ(camera.fx, expected.fx);
  EXPECT_EQ(camera.cy, expected.cy);
  EXPECT_TRUE(camera.center.isZero(0.0));
  EXPECT_TRUE(camera.rotation.isIdentity(0.0));
}

TEST(FindCamera, AxesWithYUpAndZBackwardsAreATurn) {
  const TableScene scene = TableScene().can();
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, -1).asDiagonal();
  PinholeCamera camera;
  ASSERT_TRUE(findCamera(moved(scene.inCamera(), flip, Eigen::Vector3d::Zero()),
                         scene.width,
                         scene.height,
                         std::nullopt,
                         camera));
  EXPECT_NEAR((camera.rotation - flip).norm(), 0.0, 2e-3);
}

TEST(FindCamera, WhatIsNoImageHasNone) {
  const TableScene scene = TableScene().can();
  PinholeCamera camera;
  const Eigen::Matrix3Xf points = TableScene::listOf(scene.inRoom());
  EXPECT_FALSE(findCamera(points.leftCols(120 * 120), 120, 120, std::nullopt, camera));
}
