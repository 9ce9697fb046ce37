// SPDX-License-Identifier: BSD-3-Clause
// How a picture is laid out: what fills its frame, and scale bar, axes, title, legend.
#include "pcl_sq/visualization/snapshot_renderer.h"

#include "random_superquadric.h"
#include "snapshot_scene.h"
#include "visualization/drawing/scale_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

int countDifferent(const SnapshotImage& a, const SnapshotImage& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    if (!std::equal(a.rgb.begin() + static_cast<long>(i),
                    a.rgb.begin() + static_cast<long>(i) + 3,
                    b.rgb.begin() + static_cast<long>(i)))
      ++count;
  return count;
}

} // namespace

TEST(Snapshot, FramesTheObjectAndNotItsSurroundings) {
  Eigen::Matrix3Xd wall(3, 100);
  for (Eigen::Index i = 0; i < wall.cols(); ++i)
    wall.col(i) << 0.1 * static_cast<double>(i % 10 - 5),
        0.1 * static_cast<double>(i / 10 - 5), 3.0;
  SnapshotRenderer alone(bareOptions()), before_wall(bareOptions());
  alone.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  before_wall.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  before_wall.addCloud(wall);
  EXPECT_EQ(alone.camera().pixelsPerMeter(), before_wall.camera().pixelsPerMeter());
  EXPECT_EQ(alone.render().rgb, before_wall.render().rgb); // too far to be shown

  SnapshotOptions everything = bareOptions(View::CAMERA);
  before_wall.setOptions(everything);
  const SnapshotImage without_wall = before_wall.render();
  everything.context = INFINITY;
  before_wall.setOptions(everything);
  EXPECT_GT(countDifferent(before_wall.render(), without_wall), 20);
}

TEST(Snapshot, PointsCloseToTheModelAreInTheFrame) {
  SnapshotRenderer renderer(bareOptions(View::FRONT));
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  Eigen::Matrix3Xd handle(3, 1);
  handle << 0.11, 0, 1;
  const double without = renderer.camera().project(handle.col(0)).x();
  renderer.addCloud(handle);
  EXPECT_NE(renderer.camera().project(handle.col(0)).x(), without);
}

TEST(Snapshot, StrayPointsOfABareCloudDoNotShrinkIt) {
  test::Random random(6);
  const Superquadric s = ballAt(0, 0, 1, 0.1);
  Eigen::Matrix3Xd points(3, 3000);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = random.surfacePoint(s);
  SnapshotRenderer clean(bareOptions()), stray(bareOptions());
  clean.addCloud(points);
  points.col(7) << 1e30, -1e30, 5.0;
  points.col(8) << 40.0, 0.0, 5.0;
  stray.addCloud(points);
  EXPECT_NEAR(
      stray.camera().pixelsPerMeter() / clean.camera().pixelsPerMeter(), 1, 0.1);
  EXPECT_GT(countDifferent(
                stray.render(),
                SnapshotImage{320, 240, std::vector<std::uint8_t>(3 * 320 * 240, 255)}),
            1000);
}

TEST(Snapshot, ThePictureIsTheSameAMillionMetresAway) {
  Superquadric near = ballAt(0.25, 0.5, 1, 0.125), far = near;
  near.epsilon1 = far.epsilon1 = 0.25;
  far.center.array() += 1048576.0;
  SnapshotRenderer a(bareOptions()), b(bareOptions());
  a.addModel(modelOf({near}));
  b.addModel(modelOf({far}));
  // outlines may round differently
  EXPECT_LT(countDifferent(a.render(), b.render()), 320 * 240 / 200);
}

TEST(Snapshot, ScaleBarIsAsLongAsItsLabelSays) {
  SnapshotOptions options = bareOptions(View::FRONT);
  options.width = 800;
  options.height = 600;
  options.scale_bar = true;
  SnapshotRenderer renderer(options);
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  const SnapshotImage image = renderer.render();
  // the longest dark run of the picture's lowest tenth
  int longest = 0;
  for (int y = 540; y < 600; ++y)
    for (int x = 400, run = 0; x < 800; ++x) {
      run = image.at(x, y).r < 100 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  const double scale = renderer.camera().pixelsPerMeter();
  const ScaleBar bar = roundScaleBar(longest / scale * 1.02);
  EXPECT_NEAR(longest, bar.length * scale, 2.0);
  EXPECT_GT(longest, 80);
}

TEST(Snapshot, DecorationsAppearWhenAskedForAndOnlyThen) {
  const auto picture = [](const SnapshotOptions& options, std::size_t parts) {
    SnapshotRenderer renderer(options);
    std::vector<Superquadric> row;
    for (std::size_t i = 0; i < parts; ++i)
      row.push_back(ballAt(0.3 * static_cast<double>(i), 0, 1, 0.1));
    renderer.addModel(modelOf(row));
    return renderer.render();
  };
  // dark, pale or coloured pixels in a corner that a bare picture leaves empty
  const auto inked = [](const SnapshotImage& image, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        count += image.at(x, y) != PAPER;
    return count;
  };
  SnapshotOptions options = bareOptions(View::FRONT);
  const SnapshotImage bare = picture(options, 2);
  EXPECT_EQ(inked(bare, 0, 0, 320, 40), 0);
  EXPECT_EQ(inked(bare, 0, 200, 320, 240), 0);

  options.axes = true;
  EXPECT_GT(inked(picture(options, 2), 0, 180, 80, 240), 50);
  options = bareOptions(View::FRONT);
  options.title = "A title";
  EXPECT_GT(inked(picture(options, 2), 0, 0, 160, 40), 50);
  options = bareOptions(View::FRONT);
  options.legend = true;
  EXPECT_GT(inked(picture(options, 2), 240, 0, 320, 40), 50);
  EXPECT_EQ(inked(picture(options, 1), 240, 0, 320, 15), 0);
}

TEST(Snapshot, BackgroundIsTheOneAskedFor) {
  SnapshotOptions options = bareOptions();
  options.background = {17, 34, 51};
  SnapshotRenderer renderer(options);
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  EXPECT_EQ(renderer.render().at(2, 2), options.background);
}
