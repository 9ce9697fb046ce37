// SPDX-License-Identifier: BSD-3-Clause
// Bare points of one view, taken for nothing else.
#include "observe/sheets.h"
#include "pcl_sq/object_view.h"

#include "seen_scene.h"

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Every step-th point of a can with sharp edges, seen from above. */
Eigen::Matrix3Xf pointsOfACan(double noise, Eigen::Index step) {
  TableScene scene = fineScene();
  scene.stand({0.0, 0.0}, {0.033, 0.033, 0.06}, 0.02, 1.0);
  scene.noise = noise;
  const Eigen::Matrix3Xf points = scene.inCamera();
  const LabelImage labels = truthOf(scene);
  Eigen::Matrix3Xf object(3, points.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols(); i += step)
    if (labels.values[std::size_t(i)] > 0)
      object.col(count++) = points.col(i);
  return object.leftCols(count);
}

} // namespace

TEST(OneView, WithoutAnyNoiseACurvedSurfaceIsNoThinWall) {
  // curvature is then all that parts points from their planes
  for (const Eigen::Index step : {1, 3, 7}) {
    const Eigen::Matrix3Xf object = pointsOfACan(0.0, step);
    EXPECT_LT(detail::doubled(detail::sheetsOf(object.cast<double>())), 0.03) << step;
    ObservedObject observed;
    ASSERT_TRUE(observeObject(object, int(object.cols()), 1, {}, {}, observed));
    EXPECT_EQ(observed.outline, OutlineSource::POINTS) << step;
  }
}
