// SPDX-License-Identifier: BSD-3-Clause
// Models in a user's own pcl::visualization::PCLVisualizer.
#include "pcl_sq/visualization/pcl_visualizer.h"
#include "visualization/display/private_xvfb.h"

#include "environment_variable.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

TEST(PclVisualizer, ShowsAModelUnderANameThatIsFreeAgainWhenItIsTakenOut) {
  const PrivateXvfb server;
  const test::EnvironmentVariable display("DISPLAY", server.name().c_str());
  pcl::visualization::PCLVisualizer viewer("test", false);
  Superquadric can;
  can.semi_axes = {0.033, 0.033, 0.06};
  MultiSuperquadric model;
  EXPECT_FALSE(addSuperquadric(viewer, model, "thing")) << "nothing to show";
  model.parts = {can, can};
  EXPECT_TRUE(addSuperquadric(viewer, model, "thing"));
  EXPECT_FALSE(addSuperquadric(viewer, can, "thing")) << "the name is taken";
  EXPECT_TRUE(addSuperquadric(viewer, can));
  EXPECT_TRUE(viewer.contains("superquadric"));
  EXPECT_TRUE(viewer.removePolygonMesh("thing"));
  EXPECT_TRUE(addSuperquadric(viewer, can, "thing"));
}
