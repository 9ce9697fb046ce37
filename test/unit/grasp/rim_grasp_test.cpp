// SPDX-License-Identifier: BSD-3-Clause
// Grasps across the wall of open vessels.
#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/oriented_box.h"

#include "open_body.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A bowl 160 mm wide and 60 mm high on the table z = 0. */
MultiSuperquadric bowl() {
  Superquadric s;
  s.semi_axes = {0.08, 0.08, 0.055};
  s.epsilon1 = 0.8;
  s.rim = 0.1;
  s.wall = 0.004;
  s.center.z() = s.semi_axes.z();
  MultiSuperquadric model;
  model.parts = {s};
  return model;
}

} // namespace

TEST(RimGrasp, BowlWiderThanTheHandIsHeldAtItsRim) {
  GraspScene scene;
  scene.has_table = true;
  GraspPlannerOptions options;
  options.min_observed = 0.0;
  const MultiSuperquadric object = bowl();
  const GraspPlan plan = GraspPlanner(Gripper(), options).plan(object, scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  const Superquadric& s = object.parts[0];
  for (const Grasp& grasp : plan.grasps) {
    EXPECT_LT(grasp.width, 0.008);
    for (const GraspContact& contact : grasp.contacts) {
      EXPECT_NEAR(s.euclideanDistance(contact.position), 0.0, 1e-6);
      const double cosine =
          std::abs(contact.normal.dot(grasp.closing())) / contact.normal.norm();
      EXPECT_GT(cosine, 1.0 / std::sqrt(1.0 + 0.25) - 1e-9);
    }
    // one finger in the hollow
    EXPECT_NE(s.inHollow(grasp.contacts[0].position + 1e-4 * grasp.contacts[0].normal),
              s.inHollow(grasp.contacts[1].position + 1e-4 * grasp.contacts[1].normal));
  }
}

TEST(RimGrasp, BoxesCollideWithTheMaterialOnly) {
  Random random(91);
  int free_inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Superquadric s = anyOpenBody(random, true);
    s.kx = s.ky = 0.0; // convex
    OrientedBox box;
    box.rotation = random.rotation();
    box.half_sizes = {random.uniform(0.02, 0.3), 0.05, random.uniform(0.02, 0.3)};
    box.center = random.pointNear(s);
    bool touched = false;
    constexpr int N = 12;
    for (int i = 0; i <= N && !touched; ++i)
      for (int j = 0; j <= N && !touched; ++j)
        for (int k = 0; k <= N && !touched; ++k) {
          const Eigen::Vector3d p =
              Eigen::Vector3d(i, j, k) * 2.0 / N - Eigen::Vector3d::Ones();
          touched =
              s.inMaterial(box.center + box.rotation * p.cwiseProduct(box.half_sizes));
        }
    if (touched) {
      EXPECT_TRUE(collides(box, s)) << trial;
    } else if (!collides(box, s) && s.inHollow(box.center))
      ++free_inside;
  }
  EXPECT_GT(free_inside, 5);
}

TEST(RimGrasp, ABananaOnATableIsHeldAcross) {
  // a finger reaches into its bend: 180 mm along, 32 mm thick, lying on the table
  Superquadric banana;
  banana.semi_axes = {0.016, 0.016, 0.09};
  banana.epsilon1 = 0.1;
  banana.bend = 10.0;
  banana.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0; // its circle in the table's plane
  banana.center.z() = 0.016;
  MultiSuperquadric object;
  object.parts = {banana};
  GraspScene scene;
  scene.has_table = true;
  GraspPlannerOptions options;
  options.min_observed = 0.0;
  const GraspPlan plan = GraspPlanner(Gripper(), options).plan(object, scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  EXPECT_NEAR(plan.grasps[0].width, 0.032, 1e-3);
}

TEST(RimGrasp, AHandThatOpensLessReachesBelowASlope) {
  // an edge that overhangs by 45 degrees: below it the wide opening meets the table
  Superquadric block;
  block.semi_axes = {0.03, 0.2, 0.03};
  block.epsilon1 = block.epsilon2 = 0.1;
  block.rotation = Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitY());
  block.center.z() = 0.043;
  MultiSuperquadric object;
  object.parts = {block};
  GraspScene scene;
  scene.has_table = true;
  GraspPlannerOptions options;
  options.min_observed = 0.0;
  Gripper gripper;
  ASSERT_TRUE(Gripper::preset("wsg_50", gripper));
  options.opening = 0.03;
  const GraspPlan plan = GraspPlanner(gripper, options).plan(object, scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  const bool some_open_less =
      std::any_of(plan.grasps.begin(), plan.grasps.end(), [](const Grasp& g) {
        return g.open_width < g.width + 0.03;
      });
  EXPECT_TRUE(some_open_less);
}
