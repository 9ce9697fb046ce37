// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/view_fit.h"

#include "fit_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

ObjectFitOptions onePart() {
  ObjectFitOptions options;
  options.max_parts = 1;
  return options;
}

} // namespace

TEST(ViewFit, HiddenSideOfACanIsFoundAndTheCanIsRound) {
  ViewScene scene;
  scene.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene, onePart());
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_EQ(fit.parts[0].chosen.shape, ShapeClass::ROTATIONAL);
  EXPECT_TRUE(fit.parts[0].chosen.upright);
  EXPECT_GT(fit.parts[0].margin, 0.0);
  EXPECT_GT(overlap(fit.model, scene.object), 0.93);
}

TEST(ViewFit, HiddenSideOfABoxIsFound) {
  ViewScene scene;
  scene.addUpright({0.05, 0.03, 0.06}, 0.2, 0.2, 0.06);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene, onePart());
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_GT(overlap(fit.model, scene.object), 0.9);
}

TEST(ViewFit, ResultDoesNotDependOnTheFrame) {
  ViewScene scene;
  scene.addUpright({0.05, 0.04, 0.06}, 0.6, 0.8, 0.06);
  scene.render(0.001);
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject observed;
  ASSERT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed));
  const ViewEvidence evidence = observed.evidence(observed.contour, 48, true);
  const ViewFit fit = fitView(observed.points, evidence);
  Random random(11);
  const Eigen::Matrix3d rotation = random.rotation();
  const Eigen::Vector3d shift(3.0, -2.0, 1.0);
  const auto move = [&](std::vector<TangentPlane> planes) {
    for (TangentPlane& p : planes) {
      p.normal = rotation * p.normal;
      p.offset += p.normal.dot(shift);
    }
    return planes;
  };
  ViewEvidence moved = evidence;
  moved.silhouette = move(evidence.silhouette);
  moved.tangents = move(evidence.tangents);
  moved.limits = move(evidence.limits);
  moved.up = rotation * *evidence.up;
  moved.viewpoint = rotation * *evidence.viewpoint + shift;
  const Eigen::Matrix3Xd points = (rotation * observed.points).colwise() + shift;
  const ViewFit other = fitView(points, moved);
  ASSERT_TRUE(fit.fit.ok());
  ASSERT_TRUE(other.fit.ok());
  EXPECT_NEAR(other.fit.model.volume() / fit.fit.model.volume(), 1.0, 0.02);
  EXPECT_LT((rotation * fit.fit.model.center + shift - other.fit.model.center).norm(),
            0.001);
}

TEST(ViewFit, PointsOfNoPrecisionHaveNoSay) {
  Random random(12);
  Superquadric truth;
  truth.semi_axes = {0.03, 0.05, 0.07};
  truth.epsilon1 = truth.epsilon2 = 0.6;
  Eigen::Matrix3Xd points(3, 600);
  ViewFitOptions options;
  options.noise = 0.001;
  for (int i = 0; i < points.cols(); ++i) {
    // every other point lies a noise's width outside: no outlier, but wrong
    const double scale = i % 2 ? 1.05 : 1.0;
    points.col(i) = scale * random.surfacePoint(truth);
    options.precision.push_back(i % 2 ? 1e-6F : 1.0F);
  }
  const ViewFit weighted = fitView(points, {}, options);
  EXPECT_NEAR(weighted.fit.model.volume(), truth.volume(), 0.002 * truth.volume());
  options.precision.clear();
  const ViewFit even = fitView(points, {}, options);
  EXPECT_GT(even.fit.model.volume(), 1.03 * truth.volume());
}

TEST(ViewFit, TooFewPointsGiveNoModel) {
  const ViewFit fit = fitView(Eigen::Matrix3Xd::Random(3, 5), {});
  EXPECT_FALSE(fit.fit.ok());
  EXPECT_FALSE(fitView(Eigen::Matrix3Xd(3, 0), {}).fit.ok());
}
