// SPDX-License-Identifier: BSD-3-Clause
// Open vessels seen once: bowls, mugs, plates.
#include "pcl_sq/view_fit.h"

#include "families/vessel_problem.h"
#include "fit_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Adds a vessel that stands on the table. */
Superquadric& addVessel(ViewScene& scene,
                        double a,
                        double a3,
                        double e1,
                        double taper,
                        double rim,
                        double wall) {
  scene.addUpright({a, a, a3}, e1, 1.0, a3);
  Superquadric& s = scene.object.parts.back();
  s.kx = s.ky = taper;
  s.rim = rim;
  s.wall = wall;
  return s;
}

} // namespace

TEST(VesselStarts, AHandleDoesNotMoveTheAxisOfACupFromAllRound) {
  Random random(4);
  Eigen::Matrix3Xd points(3, 2000);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double turn = random.uniform(0.0, 2.0 * M_PI);
    const double radius = i % 2 ? 0.040 : 0.036;
    if (i % 10 == 0) // the handle, at x of 40 to 65 mm
      points.col(i) << random.uniform(0.04, 0.065), random.uniform(-0.005, 0.005),
          random.uniform(0.02, 0.08);
    else
      points.col(i) << radius * std::cos(turn), radius * std::sin(turn),
          random.uniform(0.0, 0.1);
  }
  detail::ViewProblem problem;
  ASSERT_TRUE(problem.prepare(points, {}, {}));
  const detail::Normalisation& frame = problem.frame();
  const Eigen::Vector3d up = frame.axes.transpose() * Eigen::Vector3d::UnitZ();
  double nearest = 1e300;
  for (const Superquadric& start : detail::vesselStarts(problem, up))
    nearest = std::min(nearest, frame.toCloud(start).center.head<2>().norm());
  EXPECT_LT(nearest, 0.004) << "a tenth of the radius";
}

TEST(VesselFit, BowlPotAndPlateAreOpenAndTrueToSize) {
  struct Kind {
    double a, a3, e1, taper, rim, wall;
  };
  for (const Kind& k : {Kind{0.07, 0.055, 1.0, 0.0, 0.1, 0.004},
                        Kind{0.05, 0.05, 0.1, 0.15, 0.9, 0.005},
                        Kind{0.08, 0.012, 0.2, 0.3, 0.9, 0.004}}) {
    ViewScene scene = finerScene();
    const Superquadric truth =
        addVessel(scene, k.a, k.a3, k.e1, k.taper, k.rim, k.wall);
    ASSERT_TRUE(truth.isValid());
    scene.render(0.001);
    const ObjectFit fit = fitScene(scene);
    ASSERT_EQ(fit.model.size(), 1u);
    const Superquadric& s = fit.model.parts[0];
    EXPECT_EQ(fit.parts[0].chosen.shape, ShapeClass::VESSEL);
    EXPECT_TRUE(s.isHollow());
    EXPECT_GT(overlap(fit.model, scene.object), 0.93);
    const Eigen::Vector3d up = scene.table.normal;
    const auto height = [&](const Superquadric& b) {
      return b.support(up) + b.support(-up);
    };
    EXPECT_NEAR(height(s), height(truth), 0.05 * height(truth));
    EXPECT_NEAR(s.support(Eigen::Vector3d::UnitX()),
                truth.support(Eigen::Vector3d::UnitX()),
                0.03 * k.a);
  }
}

TEST(VesselFit, ClosedThingsStayClosed) {
  for (const double e1 : {0.1, 0.6, 1.0}) {
    ViewScene scene = finerScene();
    scene.addUpright({0.05, 0.05, 0.04}, e1, 1.0, 0.04);
    scene.render(0.001);
    const ObjectFit fit = fitScene(scene);
    for (const Superquadric& s : fit.model.parts)
      EXPECT_FALSE(s.isHollow()) << e1;
  }
}

TEST(VesselFit, HandleIsAPartBesideAMug) {
  ViewScene scene = finerScene();
  const Superquadric mug = addVessel(scene, 0.04, 0.05, 0.1, 0.02, 0.9, 0.004);
  Superquadric handle = mug;
  handle.kx = handle.ky = handle.wall = 0.0;
  handle.rim = 1.0;
  handle.epsilon1 = 0.3;
  handle.semi_axes = {0.006, 0.008, 0.03};
  handle.center = mug.center + 0.05 * Eigen::Vector3d::UnitX();
  scene.object.parts.push_back(handle);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 2u);
  EXPECT_NE(fit.model.parts[0].isHollow(), fit.model.parts[1].isHollow());
  EXPECT_GT(overlap(fit.model, scene.object), 0.9);
}
