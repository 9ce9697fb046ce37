// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_object.h"
#include "view_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

ViewScene canOnTable() {
  ViewScene scene;
  scene.addUpright({0.05, 0.05, 0.07}, 0.2, 1.0, 0.07);
  scene.render(0.0005);
  return scene;
}

/** \brief Takes the depth of the pixels within \a reach of the outline on either side.
 */
void dropEdge(ViewScene& scene, int reach) {
  const CellMask& mask = scene.mask;
  const Eigen::Matrix3Xf all = scene.points;
  for (int y = reach; y < scene.height - reach; ++y)
    for (int x = reach; x < scene.width - reach; ++x)
      for (int d = -reach; d <= reach; ++d)
        if (mask(x + d, y) != mask(x, y) || mask(x, y + d) != mask(x, y))
          scene.points.col(y * scene.width + x)
              .setConstant(std::numeric_limits<float>::quiet_NaN());
}

ObservedObject observed(const ViewScene& scene) {
  ObservedObject object;
  std::string why;
  EXPECT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, {}, object, &why))
      << why;
  return object;
}

} // namespace

TEST(MissingEdge, HalfOfWhatACameraDropsIsTheObjects) {
  for (const int reach : {1, 2}) {
    ViewScene scene = canOnTable();
    dropEdge(scene, reach);
    EXPECT_NEAR(observed(scene).outline_offset, -reach, 0.5);
  }
}

TEST(MissingEdge, AnOutlineThatTouchesTheBackgroundLosesNothing) {
  EXPECT_GE(observed(canOnTable()).outline_offset, 0.0);
}

TEST(MissingEdge, WidthOfACanDoesNotDependOnIt) {
  ViewScene scene = canOnTable();
  const auto width = [](const ViewScene& s) {
    const ObjectFit fit = fitObject(observed(s), {});
    return fit.model.empty() ? 0.0 : 2.0 * fit.model.parts[0].semi_axes.x();
  };
  const double whole = width(scene);
  dropEdge(scene, 1);
  EXPECT_NEAR(width(scene), whole, 0.004); // of 100 mm, a pixel being 3.3 mm
}
