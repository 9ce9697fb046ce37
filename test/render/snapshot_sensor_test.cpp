// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/snapshot_renderer.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

int brightness(const Color& c) {
  return c.r + c.g + c.b;
}

/** \brief A ball in front of the sensor, from its right side. */
SnapshotImage sideOfBall(bool sensor) {
  SnapshotOptions options;
  options.width = options.height = 240;
  options.view = View::SIDE;
  options.axes = options.scale_bar = false;
  if (sensor)
    options.sensor = Eigen::Vector3d::Zero();
  SnapshotRenderer renderer(options);
  MultiSuperquadric ball;
  ball.parts.resize(1);
  ball.parts[0].center = Eigen::Vector3d(0, 0, 1);
  ball.parts[0].semi_axes = Eigen::Vector3d::Constant(0.1);
  renderer.addModel(ball);
  return renderer.render();
}

} // namespace

TEST(SnapshotSensor, WhatTheSensorCouldNotSeeIsLighter) {
  const SnapshotImage with = sideOfBall(true), without = sideOfBall(false);
  // depth runs across the picture, one way or the other: one half changes, one does not
  const int left = brightness(with.at(80, 120)) - brightness(without.at(80, 120));
  const int right = brightness(with.at(160, 120)) - brightness(without.at(160, 120));
  EXPECT_GT(std::max(left, right), 60);
  EXPECT_LT(std::abs(std::min(left, right)), 12);
}

TEST(SnapshotSensor, APlaceThatIsNotFiniteIsRefused) {
  SnapshotOptions options;
  options.sensor = Eigen::Vector3d(0, std::nan(""), 0);
  std::string why;
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("sensor"), std::string::npos);
}
