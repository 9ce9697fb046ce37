// SPDX-License-Identifier: BSD-3-Clause
// Tins: the lid lies below the rim.
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A can as a tin, its lid so far below its rim. */
Scene estimateTin(double depth) {
  TableScene truth = fineScene();
  truth.camera = TableScene(600.0, {0.0, -0.5, 0.5}).camera;
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
    const Scene scene = estimateTin(depth);
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
