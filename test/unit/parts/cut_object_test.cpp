// SPDX-License-Identifier: BSD-3-Clause
// Objects that the image's border cuts.
#include "parts/verdict.h"

#include "fit_scene.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

constexpr double NOISE = 0.001;

/** \brief A can that the left border cuts in half, and whose columns there the other
 * camera does not see. */
ObservedObject halfACan(double e2) {
  ViewScene scene;
  scene.camera.cx = 5.0;
  scene.addUpright({0.08, 0.08, 0.1}, 0.1, e2, 0.1);
  scene.render(NOISE);
  constexpr int UNMATCHED = 17;
  for (int y = 0; y < scene.height; ++y)
    scene.points.block(0, y * scene.width, 3, UNMATCHED)
        .setConstant(std::numeric_limits<float>::quiet_NaN());
  ViewOptions view;
  view.mask = scene.mask;
  view.camera = scene.camera;
  view.find_table = false;
  ObservedObject observed;
  std::string why;
  EXPECT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed, &why))
      << why;
  return observed;
}

} // namespace

TEST(CutObject, IsFittedToItsPixelsWhereNothingWasMatched) {
  for (const double e2 : {0.2, 1.0}) {
    const ObservedObject can = halfACan(e2);
    const ObjectFit fit = fitObject(can);
    ASSERT_FALSE(fit.model.parts.empty());
    EXPECT_GT(detail::judge(fit.model, can, NOISE).pixels, 0.9) << e2;
  }
}

TEST(CutObject, ReachesToWhereItsPixelsEnd) {
  const ObservedObject can = halfACan(1.0);
  const ViewEvidence evidence = can.evidence(can.contour, 36, false);
  Superquadric right; // of what was matched
  right.semi_axes = {0.02, 0.02, 0.1};
  right.center = can.points.rowwise().mean();
  double short_of = 0.0;
  for (const TangentPlane& end : evidence.tangents)
    short_of = std::min(short_of, end.residual(right) / end.sigma);
  EXPECT_LT(short_of, -3.0);
}
