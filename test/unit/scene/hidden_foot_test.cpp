// SPDX-License-Identifier: BSD-3-Clause
// Things whose foot another thing hides stand on the table all the same.
#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief The thing of a label, as it was found. */
const SceneObject* thingOf(const Scene& scene, int label) {
  for (const SceneObject& object : scene.objects)
    if (object.label == label)
      return &object;
  return nullptr;
}

double lowest(const Scene& scene, const SceneObject& object) {
  return heightsOf(object.model, scene.table->normal, scene.table->offset).first;
}

} // namespace

TEST(HiddenFoot, OfWhichOnlyTheTopIsSeenStandsOnTheTable) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.09}, {0.035, 0.035, 0.065}, 0.1, 1.0)
      .stand({0.0, -0.02}, {0.08, 0.02, 0.05}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), truthOf(truth));
  const SceneObject* can = thingOf(scene, 1);
  ASSERT_NE(can, nullptr) << scene.failure;
  EXPECT_LT(can->visible, 0.8);
  EXPECT_TRUE(can->report.view.hidden_below);
  ASSERT_TRUE(can->report.view.table);
  EXPECT_NEAR(lowest(scene, *can), 0.0, 0.004);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  EXPECT_NEAR(can->model.support(right) + can->model.support(-right), 0.07, 0.007);
}

TEST(HiddenFoot, OfABottleIsItsBodys) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.09}, {0.035, 0.035, 0.065}, 0.2, 1.0);
  Superquadric neck = truth.things[0];
  neck.semi_axes = {0.013, 0.013, 0.03};
  neck.center.z() = 0.15;
  truth.things.push_back(neck);
  truth.stand({0.0, -0.02}, {0.08, 0.02, 0.05}, 0.1, 0.1);
  LabelImage labels = truthOf(truth);
  for (std::uint16_t& label : labels.values)
    label = label == 2 ? 1 : label;
  SceneEstimation<pcl::PointXYZRGB> estimation;
  estimation.setInputCloud(cloudOf(truth, truth.inCamera(), true));
  estimation.setLabels(labels);
  SceneOptions options;
  options.estimation.object_fit.parts = 2;
  estimation.setOptions(options);
  Scene scene;
  ASSERT_TRUE(estimation.estimate(scene)) << scene.failure;
  const SceneObject* bottle = thingOf(scene, 1);
  ASSERT_NE(bottle, nullptr);
  EXPECT_EQ(bottle->model.size(), 2u);
  EXPECT_NEAR(lowest(scene, *bottle), 0.0, 0.004);
}

TEST(HiddenFoot, HowFarAThingGoesOnIsOneUnknownHoweverManyLinesTellOfIt) {
  TableScene truth = fineScene();
  truth.stand({0.0, 0.09}, {0.035, 0.035, 0.065}, 0.1, 1.0)
      .stand({0.06, -0.02}, {0.06, 0.02, 0.06}, 0.1, 0.1);
  const Scene scene = estimate(cloudOf(truth, truth.inCamera(), true), truthOf(truth));
  const SceneObject* can = thingOf(scene, 1);
  ASSERT_NE(can, nullptr) << scene.failure;
  const ObservedObject& view = can->report.view;
  const auto weightOf = [&view](int lines) {
    double weight = 0.0;
    for (const TangentPlane& end : view.evidence(view.contour, lines, true).limits)
      weight += 1.0 / (end.sigma * end.sigma);
    return weight;
  };
  ASSERT_GT(weightOf(36), 0.0);
  EXPECT_NEAR(weightOf(144) / weightOf(36), 1.0, 1e-6);
}
