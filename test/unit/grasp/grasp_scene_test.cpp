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

namespace {

/** \brief Points of the union's surface that a viewer sees. */
Eigen::Matrix3Xd seenPoints(const MultiSuperquadric& object,
                            const Eigen::Vector3d& viewpoint,
                            Random& random) {
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t k = 0; k < object.size(); ++k)
    for (int i = 0; i < 8000; ++i) {
      const Superquadric& s = object.parts[k];
      const Eigen::Vector3d p = random.surfacePoint(s);
      bool hidden = s.normal(p).dot(viewpoint - p) <= 0.0;
      for (std::size_t other = 0; other < object.size(); ++other)
        hidden = hidden || (other != k && object.parts[other].gauge(p) < 1.0);
      if (!hidden)
        seen.push_back(p);
    }
  return Eigen::Map<Eigen::Matrix3Xd>(seen[0].data(), 3, Eigen::Index(seen.size()));
}

} // namespace

TEST(GraspScene, WhereThePointsHaveAShoulderThatTheModelLacksNothingIsHeld) {
  // the thing is a jar with a narrower lid, the model one body of the jar's width
  const MultiSuperquadric model = {
      {part({0.030, 0.030, 0.06}, 0.1, 1.0, {0.0, 0.0, 0.06})}};
  MultiSuperquadric thing;
  thing.parts = {part({0.030, 0.030, 0.04}, 0.1, 1.0, {0.0, 0.0, 0.04}),
                 part({0.018, 0.018, 0.02}, 0.1, 1.0, {0.0, 0.0, 0.1})};
  GraspScene scene = onTable();
  Random random(207);
  scene.cloud = seenPoints(thing, scene.viewpoint, random);
  const GraspPlan plan = GraspPlanner().plan(model, scene);
  ASSERT_TRUE(plan.ok()) << plan.failure;
  for (const Grasp& grasp : plan.grasps)
    for (const GraspContact& contact : grasp.contacts)
      if (contact.position.y() < 0.0) { // seen
        EXPECT_GT(std::abs(contact.position.z() - 0.08), 0.003);
      }
}

TEST(GraspScene, PointsThatTheModelExplainsTakeNoGraspAway) {
  const MultiSuperquadric object = standingBottle();
  GraspScene scene = onTable();
  const GraspPlan without = GraspPlanner().plan(object, scene);
  Random random(208);
  scene.cloud = seenPoints(object, scene.viewpoint, random);
  const GraspPlan with = GraspPlanner().plan(object, scene);
  ASSERT_TRUE(without.ok() && with.ok()) << with.failure;
  EXPECT_NEAR(with.grasps[0].scores.antipodal, without.grasps[0].scores.antipodal, 0.1);
}

TEST(GraspScene, AContactWhereTheCameraSeesTheTableIsNone) {
  // a disc for a handle whose hole shows what is behind it
  MultiSuperquadric disc;
  disc.parts = {part({0.04, 0.004, 0.04}, 1.0, 1.0, {0.0, 0.0, 0.06})};
  GraspScene scene = onTable();
  scene.has_viewpoint = true;
  scene.viewpoint = {0.0, -0.8, 0.06};
  std::vector<Eigen::Vector3d> seen;
  for (double x = -0.1; x <= 0.1; x += 0.001)
    for (double z = 0.02; z <= 0.15; z += 0.001) {
      const double radius = std::hypot(x, z - 0.06);
      const bool ring = radius > 0.025 && radius < 0.04;
      seen.emplace_back(ring ? x : 1.5 * x, ring ? -0.003 : 0.4, z);
    }
  scene.cloud =
      Eigen::Map<Eigen::Matrix3Xd>(seen[0].data(), 3, Eigen::Index(seen.size()));
  GraspPlannerOptions options;
  options.min_observed = 0.0;
  const GraspPlan plan = GraspPlanner({}, options).plan(disc, scene);
  EXPECT_GT(plan.rejections.unseen, 0u);
  for (const Grasp& grasp : plan.grasps)
    for (const GraspContact& contact : grasp.contacts)
      EXPECT_GT(std::hypot(contact.position.x(), contact.position.z() - 0.06), 0.015);
}

TEST(GraspScene, AStemAsThinAsItsPointsScatterIsNotHeld) {
  const MultiSuperquadric object = {
      {part({0.05, 0.05, 0.05}, 1.0, 1.0, {0.0, 0.0, 0.05}),
       part({0.002, 0.002, 0.012}, 0.3, 1.0, {0.0, 0.0, 0.108})}};
  GraspScene scene = onTable();
  ASSERT_TRUE(GraspPlanner().plan(object, scene).ok());
  Random random(209);
  scene.cloud = seenPoints(object, scene.viewpoint, random);
  for (Eigen::Index i = 0; i < scene.cloud.cols(); ++i)
    scene.cloud.col(i) *= 1.0 + random.uniform(-0.03, 0.03);
  const GraspPlan plan = GraspPlanner().plan(object, scene);
  EXPECT_FALSE(plan.ok());
}
