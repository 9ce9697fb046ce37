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
