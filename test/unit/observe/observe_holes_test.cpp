// SPDX-License-Identifier: BSD-3-Clause
// What holes in the depth and a missing table do to an observation.
#include "pcl_sq/fit_object.h"

#include "view_scene.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(ObserveObject, PixelsWithoutDepthCarryNoInformation) {
  ViewScene scene = canScene();
  ViewOptions view;
  view.mask = scene.mask;
  view.camera = scene.camera;
  view.correlation = 6.0; // so wide that pixels, not points, are what is counted
  ObservedObject whole, holes;
  ASSERT_TRUE(observeObject(scene.points, scene.width, scene.height, {}, view, whole));
  Random random(5);
  int gone = 0;
  for (Eigen::Index i = 0; i < scene.points.cols(); ++i)
    if (random.uniform(0.0, 1.0) < 0.4) {
      scene.points.col(i).setConstant(std::numeric_limits<float>::quiet_NaN());
      ++gone;
    }
  ASSERT_TRUE(observeObject(scene.points, scene.width, scene.height, {}, view, holes));
  const double left = 1.0 - double(gone) / double(scene.points.cols());
  EXPECT_NEAR(holes.effective_points / whole.effective_points, left, 0.08);
}

TEST(ObserveObject, WithoutMaskAndTableTheOutlineIsTheObjectsOwn) {
  const ViewScene scene = canScene();
  std::vector<int> object;
  for (std::size_t i = 0; i < scene.mask.cells.size(); ++i)
    if (scene.mask.cells[i])
      object.push_back(static_cast<int>(i));
  ViewOptions view;
  view.find_table = false;
  view.camera = scene.camera;
  ObservedObject observed;
  std::string why;
  ASSERT_TRUE(observeObject(
      scene.points, scene.width, scene.height, object, view, observed, &why))
      << why;
  EXPECT_FALSE(observed.table);
  ASSERT_FALSE(observed.contour.empty());
  for (const ContourPoint& p : observed.contour)
    EXPECT_TRUE(p.own) << p.pixel.transpose();
}

TEST(FitObject, PrecisionOfPointsIsNotTheCallers) {
  ObjectFitOptions options;
  std::string why;
  options.fit.precision.assign(10, 1.0F);
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("precision"), std::string::npos) << why;
  options = {};
  options.fit.min_epsilon = 0.01;
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("min_epsilon"), std::string::npos) << why;
}
