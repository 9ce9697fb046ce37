// SPDX-License-Identifier: BSD-3-Clause
// Length of torques and torsion of a pad: what Grasp::epsilon refers to.
#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/grasp_quality.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

MultiSuperquadric can() {
  MultiSuperquadric model;
  model.parts.resize(1);
  model.parts[0].semi_axes = {0.03, 0.03, 0.06};
  model.parts[0].epsilon1 = 0.1;
  return model;
}

GraspPlan planOf(const MultiSuperquadric& model, double friction) {
  GraspPlannerOptions options;
  options.count = 5;
  options.friction = friction;
  options.wrench_quality = true;
  return GraspPlanner({}, options).plan(model);
}

} // namespace

TEST(SoftFinger, TorsionIsTheSlidingFrictionOfAPatchByQuadrature) {
  const double mu = 0.7, a = 0.008;
  double force = 0.0, torque = 0.0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double r = a * (i + 0.5) / steps, pressure = 1.0 - r * r / (a * a);
    force += pressure * r;
    torque += mu * pressure * r * r;
  }
  EXPECT_NEAR(softFingerTorsion(mu, a), torque / force, 1e-9);
  EXPECT_EQ(softFingerTorsion(mu, 0.0), 0.0);
}

TEST(SoftFinger, EpsilonGrowsWithFriction) {
  // two jaws on a line: spinning about it is what the friction of the pads withstands
  std::vector<GraspContact> contacts(2);
  for (int i = 0; i < 2; ++i) {
    contacts[i].normal = Eigen::Vector3d::UnitX() * (i == 0 ? 1.0 : -1.0);
    contacts[i].position = 0.03 * contacts[i].normal;
  }
  double last = 0.0;
  for (const double friction : {0.1, 0.3, 0.5, 0.8, 1.0}) {
    WrenchOptions options;
    options.friction = friction;
    options.torsional_friction = softFingerTorsion(friction, 0.01);
    options.torque_length = 0.05;
    const double epsilon = wrenchQuality(contacts, options).epsilon;
    EXPECT_GT(epsilon, 1.2 * last) << friction;
    last = epsilon;
  }
}

TEST(SoftFinger, PlannedGraspsResistMoreWithMoreFriction) {
  const GraspPlan slippery = planOf(can(), 0.3), rough = planOf(can(), 1.0);
  ASSERT_TRUE(slippery.ok() && rough.ok());
  double best[2] = {0.0, 0.0};
  for (const Grasp& grasp : slippery.grasps)
    best[0] = std::max(best[0], grasp.epsilon);
  for (const Grasp& grasp : rough.grasps)
    best[1] = std::max(best[1], grasp.epsilon);
  EXPECT_GT(best[1], 2.0 * best[0]);
}

TEST(SoftFinger, TheTorqueLengthIsTheSurfacesLargestDistanceFromTheCentre) {
  MultiSuperquadric model = can();
  for (const double epsilon : {0.1, 1.0}) {
    model.parts[0].epsilon1 = epsilon;
    const GraspPlan plan = planOf(model, 0.5);
    ASSERT_TRUE(plan.ok());
    double farthest = 0.0;
    for (const Eigen::Vector3d& v : model.meshParts(200).vertices)
      farthest = std::max(farthest, (v - plan.wrench_origin).norm());
    EXPECT_GE(plan.wrench_length, farthest - 1e-12) << epsilon;
    EXPECT_LT(plan.wrench_length, 1.002 * farthest) << epsilon;
  }
}
