// SPDX-License-Identifier: BSD-3-Clause
// Stalks: what sticks out of a body is a part of its own.
#include "outlines/outline_cost.h"
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A ball, and in it a rod of some radius that sticks out. */
TableScene ballWithStalk(double radius, const Eigen::Vector3d& towards) {
  TableScene scene = fineScene();
  scene.stand({0.0, 0.0}, {0.04, 0.04, 0.036}, 1.0, 1.0);
  const Eigen::Vector3d axis = towards.normalized();
  Superquadric stalk;
  stalk.semi_axes = {radius, radius, 0.015};
  stalk.epsilon1 = 0.2;
  const Eigen::Vector3d side = axis.unitOrthogonal();
  stalk.rotation << side, axis.cross(side), axis;
  stalk.center = scene.things[0].center + 0.045 * axis;
  scene.things.push_back(stalk);
  return scene;
}

/** \brief The two as one thing. */
LabelImage asOne(const TableScene& scene) {
  LabelImage labels = truthOf(scene);
  for (std::uint16_t& label : labels.values)
    label = std::min<std::uint16_t>(label, 1);
  return labels;
}

} // namespace

TEST(Stalk, ARodThatSticksOutIsAPartUpToItsEnd) {
  for (const Eigen::Vector3d& towards :
       {Eigen::Vector3d(0.0, 0.1, 1.0), Eigen::Vector3d(1.0, 0.0, 0.4)}) {
    const TableScene truth = ballWithStalk(0.005, towards);
    const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), asOne(truth));
    ASSERT_EQ(scene.objects.size(), 1u) << scene.failure;
    const MultiSuperquadric& model = scene.objects[0].model;
    ASSERT_EQ(model.size(), 2u) << towards.transpose();
    const Eigen::Vector3d axis =
        truth.camera.rotation.transpose() * towards.normalized();
    const Eigen::Vector3d middle = truth.camera.rotation.transpose() *
                                   (truth.things[0].center - truth.camera.center);
    double end = 0.0;
    for (const Superquadric& part : model.parts)
      end = std::max(end, axis.dot(part.center - middle) + part.support(axis));
    EXPECT_NEAR(end, 0.06, 0.006) << towards.transpose();
    EXPECT_LT(model.parts[1].semi_axes.head<2>().maxCoeff(), 0.008);
  }
}

TEST(Stalk, ABallHasNone) {
  TableScene truth = ballWithStalk(0.005, Eigen::Vector3d::UnitZ());
  truth.things.pop_back();
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), truthOf(truth));
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].model.size(), 1u);
}

TEST(OutlineCost, PixelsThatAreWrongTogetherAreOneObservation) {
  ObservedObject observed;
  observed.outline = OutlineSource::MASK;
  const auto costAt = [&](double correlation) {
    observed.outline_correlation = correlation;
    return detail::contradictionCost(observed);
  };
  EXPECT_GT(costAt(1.0), 0.0);
  EXPECT_EQ(costAt(1.0), costAt(1.5)); // squares smaller than the grid's
  // a square of twice the side is one where four were
  EXPECT_NEAR(costAt(14.0), costAt(7.0) / 4.0, 1e-12);
  EXPECT_LT(costAt(7.0), 0.1 * costAt(1.0));
}
