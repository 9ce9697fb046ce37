// SPDX-License-Identifier: BSD-3-Clause
// The same thing in any frame, organized or as a list, coarse or fine: it has its size
// and stands on its table.
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/tabletop_segmentation.h"

#include "clouds.h"
#include "table_scene.h"

#include <pcl/point_types.h>

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

struct Fitted {
  MultiSuperquadric model;
  EstimationReport report;
  TableModel table;
};

/** \brief The plane removed, then the best mode. */
Fitted fit(const Cloud::Ptr& cloud) {
  Fitted fitted;
  TabletopSegmentation<pcl::PointXYZ> tabletop;
  tabletop.setInputCloud(cloud);
  const pcl::IndicesPtr object(new pcl::Indices);
  EXPECT_TRUE(tabletop.segment(*object)) << tabletop.getFailure();
  fitted.table = tabletop.getTable();
  ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  EstimationOptions options = EstimationOptions::best();
  options.view.table = fitted.table;
  estimation.setOptions(options);
  estimation.setInputCloud(cloud);
  estimation.setIndices(object);
  EXPECT_TRUE(estimation.estimate(fitted.model)) << estimation.getReport().failure;
  fitted.report = estimation.getReport();
  return fitted;
}

/** \brief One can of 66 x 120 mm, within a share, that stands on its table. */
void expectCan(const Fitted& fitted, double share) {
  ASSERT_EQ(fitted.model.size(), 1u);
  const auto [low, high] =
      heightsOf(fitted.model, fitted.table.normal, fitted.table.offset);
  EXPECT_NEAR(low, 0.0, 0.003);
  EXPECT_NEAR(high, 0.12, 0.12 * share);
  const Superquadric& s = fitted.model.parts[0];
  const Eigen::Vector3d u = fitted.table.normal.unitOrthogonal();
  const Eigen::Vector3d v = fitted.table.normal.cross(u);
  EXPECT_NEAR(2.0 * s.support(u), 0.066, 0.066 * share);
  EXPECT_NEAR(2.0 * s.support(v), 0.066, 0.066 * share);
}

} // namespace

TEST(Frames, RemovalNeverEatsTheFoot) {
  for (const int coarser : {1, 2}) {
    const TableScene scene = TableScene().can().coarser(coarser);
    expectCan(fit(organized(scene.inCamera(), scene.width, scene.height)), 0.03);
  }
}

TEST(Frames, PlaneRemovalGivesWhatTheFitFindsByItself) {
  const TableScene scene = TableScene().can();
  const Cloud::Ptr cloud = organized(scene.inCamera(), scene.width, scene.height);
  const Fitted removed = fit(cloud);
  ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setOptions(EstimationOptions::best());
  estimation.setInputCloud(cloud);
  MultiSuperquadric model;
  ASSERT_TRUE(estimation.estimate(model));
  ASSERT_EQ(model.size(), removed.model.size());
  EXPECT_EQ(model.parts[0].semi_axes, removed.model.parts[0].semi_axes);
  EXPECT_EQ(model.parts[0].center, removed.model.parts[0].center);
}

TEST(Frames, AnImageInARobotsFrameIsSeenByItsCamera) {
  const TableScene scene = TableScene().can();
  const Fitted here = fit(organized(scene.inCamera(), scene.width, scene.height));
  const Fitted room = fit(organized(scene.inRoom(), scene.width, scene.height));
  expectCan(room, 0.03);
  EXPECT_EQ(room.report.view.outline, OutlineSource::DEPTH);
  EXPECT_TRUE(room.report.view.viewpoint_known);
  EXPECT_NEAR((room.report.view.camera.center - scene.camera.center).norm(), 0.0, 1e-3);
  ASSERT_EQ(room.model.size(), here.model.size());
  const Eigen::Vector3d back =
      scene.camera.rotation * here.model.parts[0].center + scene.camera.center;
  EXPECT_NEAR((room.model.parts[0].center - back).norm(), 0.0, 5e-4);
  EXPECT_NEAR(
      (room.model.parts[0].semi_axes - here.model.parts[0].semi_axes).norm(), 0, 5e-4);
}

TEST(Frames, AListIsSeenFromItsViewpoint) {
  const TableScene scene = TableScene().can();
  const Eigen::Matrix3Xf list = TableScene::listOf(scene.inRoom());
  const Cloud::Ptr cloud = organized(list, int(list.cols()), 1);
  cloud->sensor_origin_.head<3>() = scene.camera.center.cast<float>();
  const Fitted fitted = fit(cloud);
  expectCan(fitted, 0.05);
  EXPECT_TRUE(fitted.report.view.viewpoint_known);
}

TEST(Frames, NoViewpointIsNotTheOrigin) {
  const TableScene scene = TableScene().can();
  Eigen::Matrix3Xf list = TableScene::listOf(scene.inRoom());
  list.colwise() += Eigen::Vector3f(0.8f, 0.0f, 0.75f);
  const Fitted fitted = fit(organized(list, int(list.cols()), 1));
  EXPECT_FALSE(fitted.report.view.viewpoint_known);
  ASSERT_EQ(fitted.model.size(), 1u);
  EXPECT_GT(fitted.table.normal.z(), 0.999);
  if (fitted.report.view.hasCamera()) { // a guess lies above the table
    EXPECT_GT(fitted.report.view.camera.center.z(), 0.75);
  }
}
