// SPDX-License-Identifier: BSD-3-Clause
// Things whose foot another thing hides stand on the table all the same.
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A bowl behind a taller can, seen from the side. */
TableScene bowlBehind(double can_radius) {
  TableScene scene = fineScene();
  scene.camera = TableScene(600.0, {0.0, -0.7, 0.3}).camera;
  scene.camera.cx = 159.5;
  scene.camera.cy = 119.5;
  Superquadric bowl;
  bowl.semi_axes = {0.09, 0.09, 0.06};
  bowl.rim = 0.2;
  bowl.wall = 0.004;
  bowl.center = {0.0, 0.05, 0.06};
  scene.things.push_back(bowl);
  return scene.stand({0.0, -0.1}, {can_radius, 0.05, 0.055}, 0.1, 1.0);
}

} // namespace

TEST(HiddenFoot, ABowlStandsOnTheTableAlthoughThatIsSeenBelowItsRim) {
  for (const double radius : {0.05, 0.065}) {
    const TableScene truth = bowlBehind(radius);
    const Scene scene =
        estimate(cloudOf(truth, truth.inCamera(), true), truthOf(truth));
    ASSERT_EQ(scene.objects.size(), 2u) << scene.failure;
    for (const SceneObject& object : scene.objects) {
      const auto [low, high] =
          heightsOf(object.model, scene.table->normal, scene.table->offset);
      EXPECT_NEAR(low, 0.0, 0.003) << object.label << ", " << radius;
      EXPECT_NEAR(high, object.label == 1 ? 0.072 : 0.11, 0.003) << object.label;
    }
  }
}
