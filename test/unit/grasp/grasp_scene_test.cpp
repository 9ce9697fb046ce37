// SPDX-License-Identifier: BSD-3-Clause
// The planner in a scene: table, measured points, viewpoint, other objects.
#include "grasp_objects.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(GraspScene, MeasuredPointsInTheWayAreAvoidedAndNoiseIsNot) {
  GraspScene scene = onTable();
  const GraspPlan free = GraspPlanner().plan(standingBottle(), scene);
  ASSERT_TRUE(free.ok());
  // a dense wall beside the bottle on the side of negative x
  std::vector<Eigen::Vector3d> wall;
  for (double y = -0.3; y < 0.3; y += 0.002)
    for (double z = 0.0; z < 0.4; z += 0.002)
      wall.emplace_back(-0.045, y, z);
  scene.cloud =
      Eigen::Map<Eigen::Matrix3Xd>(wall[0].data(), 3, Eigen::Index(wall.size()));
  const GraspPlan plan = GraspPlanner().plan(standingBottle(), scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  EXPECT_GT(plan.rejections.cloud, 0u);
  for (const Grasp& grasp : plan.grasps)
    for (const OrientedBox& box :
         Gripper().boxes(grasp.position, grasp.rotation, reach(Gripper(), grasp)))
      for (const Eigen::Vector3d& p : wall)
        ASSERT_FALSE(box.contains(p));
  // single flying points are no obstacle
  scene.cloud.resize(3, 40);
  Random random(203);
  for (int i = 0; i < 40; ++i)
    scene.cloud.col(i) = Eigen::Vector3d(random.uniform(-0.3, 0.3),
                                         random.uniform(-0.3, 0.3),
                                         random.uniform(0.05, 0.4));
  EXPECT_EQ(GraspPlanner().plan(standingBottle(), scene).rejections.cloud, 0u);
}

TEST(GraspScene, ContactsBesideMeasuredPointsCountAsObserved) {
  const MultiSuperquadric object = standingBottle();
  GraspScene scene = onTable();
  std::vector<Eigen::Vector3d> seen; // the half of the body towards negative x
  Random random(204);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = random.surfacePoint(object.parts[0]);
    if (p.x() < 0.0)
      seen.push_back(p);
  }
  scene.cloud =
      Eigen::Map<Eigen::Matrix3Xd>(seen[0].data(), 3, Eigen::Index(seen.size()));
  int near = 0;
  for (const Grasp& grasp : GraspPlanner().plan(object, scene).grasps)
    for (const GraspContact& contact : grasp.contacts)
      if (contact.part == 0 && contact.position.x() < -0.005 &&
          contact.normal.y() <= 0.0) { // towards the viewer
        EXPECT_GE(contact.observed, 0.9);
        ++near;
      } else if (contact.position.x() > 0.01) {
        EXPECT_LE(contact.observed, 0.5);
      }
  EXPECT_GT(near, 10);
}

TEST(GraspScene, AnotherObjectInTheWayIsAvoided) {
  GraspScene scene = onTable();
  scene.obstacles.parts = {part({0.05, 0.05, 0.15}, 0.2, 0.2, {0.12, 0.0, 0.15})};
  const GraspPlan plan = GraspPlanner().plan(standingBottle(), scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  for (const Grasp& grasp : plan.grasps)
    for (const OrientedBox& box :
         Gripper().boxes(grasp.position, grasp.rotation, reach(Gripper(), grasp)))
      EXPECT_GE(distance(box, scene.obstacles.parts[0]), 0.002 - 1e-6);
}

TEST(GraspScene, PointsOnTheInsideOfACupDoNotMakeItsFarSideObserved) {
  MultiSuperquadric object;
  object.parts = {part({0.035, 0.035, 0.05}, 0.1, 1.0, {0.0, 0.0, 0.05})};
  GraspScene scene = onTable();
  // the near half of the outside, and the far half of the inside, 3 mm thick
  std::vector<Eigen::Vector3d> seen;
  Superquadric inside = object.parts[0];
  inside.semi_axes.head<2>().array() -= 0.003;
  Random random(205);
  for (int i = 0; i < 8000; ++i) {
    const Eigen::Vector3d outer = random.surfacePoint(object.parts[0]);
    const Eigen::Vector3d inner = random.surfacePoint(inside);
    if (outer.y() < 0.0)
      seen.push_back(outer);
    if (inner.y() > 0.0)
      seen.push_back(inner);
  }
  scene.cloud =
      Eigen::Map<Eigen::Matrix3Xd>(seen[0].data(), 3, Eigen::Index(seen.size()));
  const GraspPlan plan = GraspPlanner().plan(object, scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  for (const Grasp& grasp : plan.grasps)
    for (const GraspContact& contact : grasp.contacts) {
      const double bound = contact.normal.y() > 0.8 ? 0.0 : 1.0;
      EXPECT_LE(contact.observed, bound);
    }
}

TEST(GraspScene, NoGraspIsGivenWhereNeitherContactWasSeen) {
  MultiSuperquadric
      object; // a ball in front and a ball behind that hides in its shadow
  object.parts = {part({0.09, 0.09, 0.09}, 1.0, 1.0, {0.0, 0.0, 0.09}),
                  part({0.02, 0.02, 0.02}, 1.0, 1.0, {0.0, 0.12, 0.07})};
  GraspScene scene = onTable();
  std::vector<Eigen::Vector3d> seen;
  Random random(206);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = random.surfacePoint(object.parts[0]);
    if (p.y() < 0.0)
      seen.push_back(p);
  }
  scene.cloud =
      Eigen::Map<Eigen::Matrix3Xd>(seen[0].data(), 3, Eigen::Index(seen.size()));
  GraspPlannerOptions options;
  options.min_observed = 0.6;
  const GraspPlan plan = GraspPlanner({}, options).plan(object, scene);
  EXPECT_FALSE(plan.ok());
  EXPECT_GT(plan.rejections.unseen, 0u);
  EXPECT_NE(plan.failure.find("not seen"), std::string::npos) << plan.failure;
  options.min_observed = 0.0;
  EXPECT_TRUE(GraspPlanner({}, options).plan(object, scene).ok());
}
