// SPDX-License-Identifier: BSD-3-Clause
// Tins: the lid lies below the rim.
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A can as a tin, its lid so far below its rim, seen from a place. */
Scene estimateTin(double depth, const Eigen::Vector3d& from) {
  TableScene truth = fineScene();
  truth.camera = TableScene(600.0, from).camera;
  truth.camera.cx = 159.5;
  truth.camera.cy = 119.5;
  truth.can();
  Eigen::Matrix3Xf room = truth.inRoom();
  const Superquadric& can = truth.things[0];
  const double top = 2.0 * can.semi_axes.z();
  for (Eigen::Index i = 0; i < room.cols(); ++i) {
    const Eigen::Vector3d p = room.col(i).cast<double>();
    const Eigen::Vector3d ray = p - truth.camera.center;
    const Eigen::Vector3d lid = p + depth / -ray.z() * ray;
    if (p.head<2>().norm() < 0.9 * can.semi_axes.x() && p.z() > top - 0.01 &&
        lid.head<2>().norm() < 0.9 * can.semi_axes.x())
      room.col(i) = lid.cast<float>();
  }
  const Eigen::Matrix3Xf seen = (truth.camera.rotation.transpose() *
                                 (room.cast<double>().colwise() - truth.camera.center))
                                    .cast<float>();
  return estimate(cloudOf(truth, seen, true), truthOf(truth));
}

} // namespace

TEST(LidFit, ATinIsRoundAndAsHighAsItsRim) {
  for (const double depth : {0.0, 0.005, 0.008}) {
    const Scene scene = estimateTin(depth, {0.0, -0.5, 0.5});
    ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
    ASSERT_EQ(scene.objects[0].model.size(), 1u);
    const Superquadric& tin = scene.objects[0].model.parts[0];
    EXPECT_EQ(scene.objects[0].report.parts[0].shape.shape, ShapeClass::ROTATIONAL)
        << depth;
    EXPECT_NEAR(tin.semi_axes.x(), 0.033, 0.0015) << depth;
    EXPECT_NEAR(
        heightsOf(scene.objects[0].model, scene.table->normal, scene.table->offset)
            .second,
        0.12,
        0.004)
        << depth;
  }
}

TEST(LidFit, ATinIsRoundWhereMoreOfItsLidThanOfItsWallIsSeen) {
  // among the lid's points its rounds change their minds about some: the best one
  // counts
  for (const Eigen::Vector3d& from : {Eigen::Vector3d(0.0, -0.35, 0.65),
                                      Eigen::Vector3d(0.1, -0.3, 0.7),
                                      Eigen::Vector3d(-0.1, -0.4, 0.6)}) {
    const Scene scene = estimateTin(0.006, from);
    ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
    EXPECT_EQ(scene.objects[0].report.parts[0].shape.shape, ShapeClass::ROTATIONAL)
        << from.transpose();
    EXPECT_NEAR(scene.objects[0].model.parts[0].semi_axes.x(), 0.033, 0.0015)
        << from.transpose();
  }
}
