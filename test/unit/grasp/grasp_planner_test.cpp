// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/grasp_planner.h"

#include "grasp_objects.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief The object in another frame. */
MultiSuperquadric
moved(MultiSuperquadric object, const Eigen::Matrix3d& r, const Eigen::Vector3d& t) {
  for (Superquadric& s : object.parts) {
    s.rotation = r * s.rotation;
    s.center = r * s.center + t;
  }
  return object;
}

} // namespace

TEST(GraspPlanner, AnySymmetryOfASuperquadricGivesBothContactsTheSameAngle) {
  Random random(201);
  for (int i = 0; i < 300; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d p = random.surfacePoint(s), y = s.toLocal(p);
    const Eigen::Vector3d n = s.normal(p);
    for (unsigned g = 1; g < 8; ++g) {
      const Eigen::Vector3d signs(g & 1u ? -1 : 1, g & 2u ? -1 : 1, g & 4u ? -1 : 1);
      const Eigen::Vector3d q = s.toWorld(signs.cwiseProduct(y));
      EXPECT_NEAR(s.gauge(q), 1.0, 1e-9);
      EXPECT_NEAR(n.dot(p - q), s.normal(q).dot(q - p), 1e-9);
      if (g == 7) { // the closed form through the centre: h(n) = n . y on the surface
        EXPECT_NEAR(n.dot(p - q), 2.0 * s.support(n), 1e-6 * s.support(n));
      }
    }
  }
}

TEST(GraspPlanner, ContactsLieOnTheUnionInsideOfTheirFrictionCones) {
  for (const MultiSuperquadric& object : {cup(), standingBottle()}) {
    const GraspPlanner planner;
    const GraspPlan plan = planner.plan(object, onTable());
    ASSERT_TRUE(plan.ok()) << plan.failure;
    for (const Grasp& grasp : plan.grasps) {
      ASSERT_EQ(grasp.contacts.size(), 2u);
      EXPECT_NEAR(grasp.rotation.determinant(), 1.0, 1e-9);
      EXPECT_NEAR((grasp.rotation.transpose() * grasp.rotation).trace(), 3.0, 1e-9);
      for (std::size_t c = 0; c < 2; ++c) {
        const GraspContact& contact = grasp.contacts[c];
        EXPECT_NEAR(object.gauge(contact.position), 1.0, 1e-6);
        const Eigen::Vector3d out = (c == 0 ? 1.0 : -1.0) * grasp.closing();
        EXPECT_GE(contact.normal.dot(out), 1.0 / std::sqrt(1.0 + 0.25) - 1e-9);
        // the finger meets nothing before the contact
        for (double d = 1e-4; d < 0.03; d += 5e-4)
          EXPECT_GT(object.gauge(contact.position + d * out), 1.0);
      }
      EXPECT_NEAR((grasp.contacts[0].position - grasp.contacts[1].position).norm(),
                  grasp.width,
                  1e-9);
      EXPECT_LE(grasp.width, planner.getGripper().max_opening);
    }
  }
}

TEST(GraspPlanner, TheHandNeitherCutsTheObjectNorTheTable) {
  for (const std::string& name : Gripper::presetNames()) {
    Gripper gripper;
    ASSERT_TRUE(Gripper::preset(name, gripper));
    const GraspPlannerOptions options;
    for (const MultiSuperquadric& object : {cup(), standingBottle()}) {
      const GraspPlan plan = GraspPlanner(gripper, options).plan(object, onTable());
      ASSERT_TRUE(plan.ok()) << name << ": " << plan.failure;
      for (const Grasp& grasp : plan.grasps) {
        std::vector<double> out = reach(gripper, grasp);
        for (double& r : out)
          r += options.compliance;
        for (const double back : {0.0, 0.03, 0.1}) // along the approach
          for (const OrientedBox& box : gripper.boxes(
                   grasp.position - back * grasp.approach(), grasp.rotation, out)) {
            for (const Superquadric& s : object.parts)
              EXPECT_GT(distance(box, s), 0.0) << name;
            for (const Eigen::Vector3d& corner : box.corners())
              EXPECT_GE(corner.z(), options.clearance - 1e-9) << name;
          }
      }
    }
  }
}

TEST(GraspPlanner, GraspsAreRankedDistinctAndRepeatable) {
  const GraspPlannerOptions options;
  const GraspPlan plan = GraspPlanner().plan(cup(), onTable());
  const GraspPlan again = GraspPlanner().plan(cup(), onTable());
  ASSERT_EQ(plan.grasps.size(), options.count);
  ASSERT_EQ(again.grasps.size(), plan.grasps.size());
  std::vector<bool> held(cup().size(), false);
  for (std::size_t i = 0; i < plan.grasps.size(); ++i) {
    const Grasp& a = plan.grasps[i];
    EXPECT_EQ(a.position, again.grasps[i].position);
    EXPECT_EQ(a.rotation, again.grasps[i].rotation);
    held[a.contacts[0].part] = true;
    for (std::size_t j = 0; j < i; ++j) {
      const Grasp& b = plan.grasps[j];
      EXPECT_GE(b.scores.total, a.scores.total);
      const double apart = (a.position - b.position).norm() / options.min_distance +
                           (2 - 2 * std::abs(a.closing().dot(b.closing()))) +
                           (2 - 2 * a.approach().dot(b.approach()));
      EXPECT_GT(apart, 0.02) << i << " repeats " << j;
    }
  }
  EXPECT_TRUE(held[0] && held[1] && held[2]); // body and handle
}

TEST(GraspPlanner, EveryScoreTermIsAShareAndTheTotalTheirWeightedMean) {
  GraspPlannerOptions options;
  options.weights = {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const Grasp& g : GraspPlanner({}, options).plan(cup(), onTable()).grasps)
    EXPECT_NEAR(g.scores.total, g.scores.antipodal, 1e-12);
  for (const Grasp& g : GraspPlanner().plan(cup(), onTable()).grasps)
    for (const double term : {g.scores.antipodal,
                              g.scores.robustness,
                              g.scores.observed,
                              g.scores.centre,
                              g.scores.clearance,
                              g.scores.approach,
                              g.scores.opening,
                              g.scores.total}) {
      EXPECT_GE(term, 0.0);
      EXPECT_LE(term, 1.0);
    }
}

TEST(GraspPlanner, ThePlanMovesWithTheFrame) {
  Random random(202);
  const Eigen::Matrix3d r = random.rotation();
  const Eigen::Vector3d t(0.3, -1.0, 2.0);
  GraspScene scene = onTable(), turned = scene;
  turned.table_normal = r * scene.table_normal;
  turned.table_offset = -turned.table_normal.dot(t);
  turned.viewpoint = r * scene.viewpoint + t;
  const GraspPlan a = GraspPlanner().plan(standingBottle(), scene);
  const GraspPlan b = GraspPlanner().plan(moved(standingBottle(), r, t), turned);
  ASSERT_EQ(a.grasps.size(), b.grasps.size());
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(a.grasps[i].scores.total, b.grasps[i].scores.total, 1e-6);
}

TEST(GraspPlanner, TwoBoxesSideBySideAreHeldAsOneObject) {
  MultiSuperquadric object; // a bar cut in two: each half alone would be held across
  object.parts = {part({0.02, 0.03, 0.03}, 0.1, 0.1, {-0.019, 0.0, 0.0}),
                  part({0.02, 0.03, 0.03}, 0.1, 0.1, {0.019, 0.0, 0.0})};
  Gripper gripper;
  ASSERT_TRUE(Gripper::preset("wsg_50", gripper));
  bool across_the_cut = false;
  for (const Grasp& grasp : GraspPlanner(gripper).plan(object).grasps)
    if (std::abs(grasp.closing().x()) > 0.95) {
      EXPECT_NEAR(grasp.width, 0.078, 0.004);
      EXPECT_NE(grasp.contacts[0].part, grasp.contacts[1].part);
      across_the_cut = true;
    }
  EXPECT_TRUE(across_the_cut);
}

TEST(GraspPlanner, AnObjectWiderThanTheGripperNamesTheNearestMiss) {
  MultiSuperquadric ball;
  ball.parts = {part({0.06, 0.06, 0.06}, 1.0, 1.0, {0, 0, 0.06})};
  const GraspPlan plan = GraspPlanner().plan(ball);
  EXPECT_FALSE(plan.ok());
  EXPECT_NE(plan.failure.find("too wide"), std::string::npos) << plan.failure;
  EXPECT_NE(plan.failure.find("120.0 mm"), std::string::npos) << plan.failure;
  Gripper thick;
  thick.min_opening = 0.05;
  ball.parts[0].semi_axes.setConstant(0.01);
  EXPECT_NE(GraspPlanner(thick).plan(ball).failure.find("too thin"), std::string::npos);
}

TEST(GraspPlanner, BadInputIsRefusedWithAReason) {
  const auto failure = [](const Gripper& g,
                          const GraspPlannerOptions& o,
                          const MultiSuperquadric& m,
                          const GraspScene& s = {}) {
    return GraspPlanner(g, o).plan(m, s).failure;
  };
  EXPECT_NE(failure({}, {}, {}).find("no parts"), std::string::npos);
  GraspPlannerOptions options;
  options.friction = -0.1;
  EXPECT_NE(failure({}, options, cup()).find("friction"), std::string::npos);
  options.friction = std::nan("");
  EXPECT_NE(failure({}, options, cup()).find("friction"), std::string::npos);
  Gripper gripper;
  gripper.max_opening = -1.0;
  EXPECT_NE(failure(gripper, {}, cup()).find("gripper"), std::string::npos);
  MultiSuperquadric broken = cup();
  broken.parts[1].semi_axes.x() = 0.0;
  EXPECT_NE(failure({}, {}, broken).find("semi-axis"), std::string::npos);
  GraspScene scene = onTable();
  scene.table_normal *= 2.0;
  EXPECT_NE(failure({}, {}, cup(), scene).find("normal"), std::string::npos);
  EXPECT_FALSE(Gripper::preset("tentacle", gripper));
}

TEST(GraspPlanner, ATableAboveTheObjectLeavesOnlyCollisions) {
  GraspScene scene = onTable();
  scene.table_offset = -0.2;
  const GraspPlan plan = GraspPlanner().plan(cup(), scene);
  EXPECT_FALSE(plan.ok());
  EXPECT_NE(plan.failure.find("the table"), std::string::npos) << plan.failure;
  EXPECT_GT(plan.rejections.table, 0u);
}

TEST(GraspPlanner, WrenchQualityIsComputedOnDemand) {
  GraspPlannerOptions options;
  options.count = 3;
  for (const Grasp& grasp : GraspPlanner({}, options).plan(cup()).grasps)
    EXPECT_EQ(grasp.epsilon, 0.0);
  options.wrench_quality = true;
  const GraspPlan plan = GraspPlanner({}, options).plan(cup());
  ASSERT_EQ(plan.grasps.size(), 3u);
  for (const Grasp& grasp : plan.grasps) {
    EXPECT_GT(grasp.epsilon, 0.0); // antipodal soft fingers close
    EXPECT_LT(grasp.epsilon, 1.0);
    EXPECT_GT(grasp.volume, 0.0);
  }
}

TEST(GraspPlanner, ThreeFingersHoldABottleWithBalancedForces) {
  Gripper gripper;
  ASSERT_TRUE(Gripper::preset("robotiq_3f", gripper));
  const GraspPlan plan = GraspPlanner(gripper).plan(standingBottle(), onTable());
  ASSERT_TRUE(plan.ok()) << plan.failure;
  for (const Grasp& grasp : plan.grasps) {
    ASSERT_EQ(grasp.contacts.size(), 3u);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
    for (int i = 0; i < 3; ++i) {
      const GraspContact& contact = grasp.contacts[std::size_t(i)];
      const Eigen::Vector3d push = -gripper.fingerDirection(grasp.rotation, i);
      EXPECT_NEAR(standingBottle().gauge(contact.position), 1.0, 1e-6);
      EXPECT_GE(-contact.normal.dot(push), 1.0 / std::sqrt(1.25) - 1e-9);
      force += push;
      torque += (contact.position - grasp.position).cross(push);
    }
    EXPECT_LT(force.norm(), 1e-9);
    EXPECT_LT(torque.norm(), 1e-9);
  }
}
