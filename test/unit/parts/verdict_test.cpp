// SPDX-License-Identifier: BSD-3-Clause
#include "parts/verdict.h"

#include "view_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

constexpr double SENSOR_NOISE = 0.001;

ViewScene boxScene() {
  ViewScene scene;
  scene.addUpright({0.05, 0.05, 0.08}, 0.2, 0.2, 0.08);
  scene.render(SENSOR_NOISE);
  return scene;
}

ObservedObject observed(const ViewScene& scene) {
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject object;
  std::string why;
  EXPECT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, object, &why))
      << why;
  return object;
}

} // namespace

TEST(Verdict, BelievesTheTruth) {
  const ViewScene scene = boxScene();
  const detail::Verdict verdict =
      detail::judge(scene.object, observed(scene), SENSOR_NOISE);
  EXPECT_GT(verdict.confidence(), 0.9);
  EXPECT_EQ(verdict.objection(), "");
}

TEST(Verdict, ObjectsToANeedle) {
  const ViewScene scene = boxScene();
  MultiSuperquadric needle = scene.object;
  needle.parts[0].semi_axes = {0.001, 0.001, 0.3};
  EXPECT_NE(detail::judge(needle, observed(scene), SENSOR_NOISE).objection(), "");
}

TEST(Verdict, ObjectsToAModelOfAPieceOfTheObject) {
  const ViewScene scene = boxScene();
  MultiSuperquadric piece = scene.object;
  piece.parts[0].semi_axes *= 0.8;
  EXPECT_LT(detail::judge(piece, observed(scene), SENSOR_NOISE).pixels, 0.8);
  EXPECT_NE(detail::judge(piece, observed(scene), SENSOR_NOISE).objection(), "");
}

TEST(Verdict, ObjectsToAModelThatTheBackgroundIsSeenThrough) {
  const ViewScene scene = boxScene();
  MultiSuperquadric huge = scene.object;
  huge.parts[0].semi_axes *= 3.0;
  const detail::Verdict verdict = detail::judge(huge, observed(scene), SENSOR_NOISE);
  EXPECT_LT(verdict.background, 0.8);
}

TEST(ObservedObject, LetsAModelEndAboutWhereTheImageCutsTheObject) {
  ViewScene scene = boxScene();
  // the camera's picture ends in the middle of the object
  const CellRect box = boundingRect(scene.mask);
  const int height = box.y + box.height / 2;
  const Eigen::Matrix3Xf points = scene.points.leftCols(scene.width * height);
  ViewOptions view;
  view.camera = scene.camera;
  view.find_table = false;
  view.mask = CellMask(scene.width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < scene.width; ++x)
      view.mask.set(x, y, scene.mask(x, y));
  ObservedObject object;
  ASSERT_TRUE(observeObject(points, scene.width, height, {}, view, object));
  const ViewEvidence evidence = object.evidence(object.contour, 36, false);
  std::vector<TangentPlane> ends = evidence.tangents;
  ends.insert(ends.end(), evidence.limits.begin(), evidence.limits.end());
  ASSERT_FALSE(ends.empty());
  double out = -1e300; // of the whole body, beyond any of them, in their sigmas
  for (const TangentPlane& end : ends)
    out = std::max(out, end.residual(scene.object.parts[0]) / end.sigma);
  EXPECT_GT(out, 3.0);
}
