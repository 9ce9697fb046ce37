// SPDX-License-Identifier: BSD-3-Clause
// Bent rods seen once: bananas.
#include "pcl_sq/view_fit.h"

#include "fit_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

ViewScene finerScene() {
  ViewScene scene(0.6);
  scene.width = 320;
  scene.height = 240;
  scene.camera.fx = scene.camera.fy = 600.0;
  scene.camera.cx = 159.5;
  scene.camera.cy = 119.5;
  return scene;
}

/** \brief Adds a rod of radius .016 that lies on the table. */
Superquadric& addRod(ViewScene& scene, double bend) {
  scene.addUpright({0.016, 0.016, 0.09}, 0.4, 1.0, 0.016);
  Superquadric& s = scene.object.parts.back();
  s.rotation *= Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  s.bend = bend;
  return s;
}

} // namespace

TEST(BentFit, BananaIsOneBentRodTrueToSize) {
  for (const double bend : {8.0, 13.0}) {
    ViewScene scene = finerScene();
    const Superquadric truth = addRod(scene, bend);
    ASSERT_TRUE(truth.isValid());
    scene.render(0.001);
    const ObjectFit fit = fitScene(scene);
    ASSERT_EQ(fit.model.size(), 1u);
    EXPECT_EQ(fit.parts[0].chosen.shape, ShapeClass::BENT);
    EXPECT_GT(overlap(fit.model, scene.object), 0.85);
    EXPECT_NEAR(std::abs(fit.model.parts[0].bend), bend, 0.1 * bend);
  }
}

TEST(BentFit, StraightRodStaysStraight) {
  ViewScene scene = finerScene();
  addRod(scene, 0.0);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_FALSE(fit.model.parts[0].isBent());
}
