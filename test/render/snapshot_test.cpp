// SPDX-License-Identifier: BSD-3-Clause
// What is in the picture, held against the mathematics of the camera.
#include "pcl_sq/visualization/snapshot_renderer.h"

#include "pcl_sq/exception.h"
#include "random_superquadric.h"
#include "visualization/drawing/scale_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pcl_sq;

namespace {

const Color PAPER{255, 255, 255};

SnapshotOptions bareOptions(View view = View::ISO) {
  SnapshotOptions options;
  options.width = 320;
  options.height = 240;
  options.view = view;
  options.axes = options.scale_bar = options.legend = false;
  return options;
}

/** \brief Whether the line of sight through a pixel meets the superquadric: the gauge
 * is convex along it, so its least value is found by ternary search. */
bool meets(const Superquadric& s, const ViewCamera& camera, double x, double y) {
  const Eigen::Vector2d offset = (Eigen::Vector2d(x, y) - camera.principalPoint())
                                     .cwiseProduct(Eigen::Vector2d(1, -1));
  Eigen::Vector3d origin = camera.position(), direction = camera.forward();
  if (camera.perspective()) {
    direction +=
        (camera.right() * offset.x() + camera.up() * offset.y()) / camera.focalLength();
  } else {
    origin += (camera.right() * offset.x() + camera.up() * offset.y()) /
              camera.pixelsPerMeter();
  }
  const double middle = (s.center - origin).dot(direction) / direction.squaredNorm();
  if ((origin + middle * direction - s.center).norm() > s.semi_axes.norm())
    return false; // outside of the ball around it
  const double reach = 2.0 * s.semi_axes.norm() / direction.norm();
  double low = middle - reach, high = middle + reach;
  for (int i = 0; i < 32; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    const double gauge_a = s.gauge(origin + a * direction);
    const double gauge_b = s.gauge(origin + b * direction);
    if (std::min(gauge_a, gauge_b) <= 1.0)
      return true;
    if (gauge_a < gauge_b)
      high = b;
    else
      low = a;
  }
  return false;
}

/** \brief Pixels in which picture and mathematics differ, the border's own pixels left
 * out (lines of the outline are two pixels wide). */
int wrongPixels(const SnapshotImage& image,
                const ViewCamera& camera,
                const Superquadric& s) {
  constexpr double BORDER = 2.5;
  int wrong = 0;
  for (int y = 0; y < image.height; y += 3)
    for (int x = 0; x < image.width; x += 3) {
      const bool inside = meets(s, camera, x + 0.5, y + 0.5);
      bool border = false;
      for (int k = 0; k < 8 && !border; ++k)
        border = meets(s,
                       camera,
                       x + 0.5 + BORDER * std::cos(k * M_PI / 4),
                       y + 0.5 + BORDER * std::sin(k * M_PI / 4)) != inside;
      if (!border && inside != (image.at(x, y) != PAPER))
        ++wrong;
    }
  return wrong;
}

int countDifferent(const SnapshotImage& a, const SnapshotImage& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); i += 3)
    if (!std::equal(a.rgb.begin() + static_cast<long>(i),
                    a.rgb.begin() + static_cast<long>(i) + 3,
                    b.rgb.begin() + static_cast<long>(i)))
      ++count;
  return count;
}

MultiSuperquadric modelOf(const std::vector<Superquadric>& parts) {
  return {parts};
}

Superquadric ballAt(double x, double y, double z, double radius) {
  Superquadric s;
  s.center = {x, y, z};
  s.semi_axes.setConstant(radius);
  return s;
}

/** \brief Share of a colour in a picture's pixel, paper and black apart: its hue. */
Eigen::Vector3d hue(Color c) {
  const Eigen::Vector3d rgb(c.r, c.g, c.b);
  return (rgb.array() - rgb.minCoeff()).matrix() /
         std::max(1.0, rgb.maxCoeff() - rgb.minCoeff());
}

} // namespace

TEST(Snapshot, SilhouetteIsWhereTheCameraMathematicsSays) {
  test::Random random(11);
  for (const View view : {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA})
    for (int i = 0; i < 3; ++i) {
      Superquadric s = random.superquadric();
      if (i == 0)
        s.epsilon1 = s.epsilon2 = 0.05;
      if (i == 1)
        s.epsilon1 = s.epsilon2 = 2.0;
      SnapshotOptions options = bareOptions(view);
      options.width = 200;
      options.height = 150;
      SnapshotRenderer renderer(options);
      renderer.addModel(modelOf({s}));
      const SnapshotImage image = renderer.render();
      EXPECT_EQ(wrongPixels(image, renderer.camera(), s), 0)
          << toString(view) << " " << s.epsilon1 << " " << s.epsilon2;
    }
}

TEST(Snapshot, PartsHaveDistinctColoursInTheirOrder) {
  std::vector<Superquadric> row;
  for (int i = 0; i < 7; ++i)
    row.push_back(ballAt(0.3 * i, 0, 1, 0.1));
  SnapshotRenderer renderer(bareOptions(View::FRONT));
  renderer.addModel(modelOf(row));
  const SnapshotImage image = renderer.render();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Eigen::Vector3d pixel = renderer.camera().project(row[i].center);
    const Color seen =
        image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    EXPECT_LT((hue(seen) - hue(partColor(i))).norm(), 0.25) << "part " << i;
  }
}

TEST(Snapshot, PartsOfSeveralModelsAreCountedOn) {
  SnapshotRenderer once(bareOptions()), twice(bareOptions());
  const Superquadric a = ballAt(0, 0, 1, 0.1), b = ballAt(0.15, 0, 1, 0.1);
  once.addModel(modelOf({a, b}));
  twice.addModel(modelOf({a}));
  twice.addModel(modelOf({b}));
  EXPECT_EQ(once.render().rgb, twice.render().rgb);
}

TEST(Snapshot, OpacityDecidesWhatIsSeenThroughASurface) {
  const Superquadric ball = ballAt(0, 0, 1, 0.1);
  Eigen::Matrix3Xd cloud(3, 400);
  for (Eigen::Index i = 0; i < cloud.cols(); ++i)
    cloud.col(i) << 0.004 * static_cast<double>(i % 20 - 10),
        0.004 * static_cast<double>(i / 20 - 10), 1.0;
  SnapshotRenderer::Colors red(3, 400);
  red.colwise() = Eigen::Matrix<std::uint8_t, 3, 1>(255, 0, 0);
  const auto middle = [&](double opacity, bool with_cloud) {
    SnapshotOptions options = bareOptions(View::FRONT);
    options.opacity = opacity;
    options.point_size = 20;
    SnapshotRenderer renderer(options);
    renderer.addModel(modelOf({ball}));
    if (with_cloud)
      renderer.addCloud(cloud, red);
    return renderer.render().at(160, 120);
  };
  EXPECT_EQ(middle(0.0, true), (Color{255, 0, 0}));
  EXPECT_EQ(middle(0.0, false), PAPER);
  EXPECT_EQ(middle(1.0, true), middle(1.0, false));
  EXPECT_LT(middle(0.5, true).g, middle(0.5, false).g - 20);
}

TEST(Snapshot, CloudPointsAppearInTheirOwnColours) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 0, 1, 0, 0, 1, 1, 2, 2, 2, 2;
  SnapshotRenderer::Colors colors(3, 4);
  colors << 200, 10, 10, 90, 10, 180, 10, 90, 10, 10, 160, 90;
  SnapshotOptions options = bareOptions(View::FRONT);
  options.point_size = 9;
  SnapshotRenderer renderer(options);
  renderer.addCloud(points, colors);
  const SnapshotImage image = renderer.render();
  for (Eigen::Index i = 0; i < 4; ++i) {
    const Eigen::Vector3d pixel = renderer.camera().project(points.col(i));
    const Color seen =
        image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
    EXPECT_EQ(seen, (Color{colors(0, i), colors(1, i), colors(2, i)})) << i;
  }
}

TEST(Snapshot, NonFinitePointsAreLeftOutWithTheirColours) {
  Eigen::Matrix3Xd points(3, 3);
  points << NAN, 0, 1, 0, 0, 1, 1, 1, 1;
  SnapshotRenderer::Colors colors(3, 3);
  colors << 1, 200, 30, 2, 100, 30, 3, 0, 200;
  SnapshotRenderer with(bareOptions(View::FRONT)), without(bareOptions(View::FRONT));
  with.addCloud(points, colors);
  without.addCloud(points.rightCols(2), colors.rightCols(2));
  EXPECT_EQ(with.render().rgb, without.render().rgb);
}

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

TEST(Snapshot, PicturesAreRepeatable) {
  SnapshotRenderer renderer(bareOptions());
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1), ballAt(0.1, 0, 1, 0.1)}));
  EXPECT_EQ(renderer.render().rgb, renderer.render().rgb);
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

TEST(Snapshot, MeshesLinesBoxesAndMarkersAreSeenWhereTheyAre) {
  const Color color{180, 20, 60};
  const auto seenAt = [&](const SnapshotRenderer& renderer, const Eigen::Vector3d& p) {
    const Eigen::Vector3d pixel = renderer.camera().project(p);
    const SnapshotImage image = renderer.render();
    return hue(image.at(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())));
  };
  const SnapshotOptions options = bareOptions(View::FRONT);
  SnapshotRenderer mesh(options), lines(options), boxes(options), markers(options);
  mesh.addMesh(meshSuperquadric(ballAt(0, 0, 1, 0.1)), color);
  EXPECT_LT((seenAt(mesh, {0, 0, 0.9}) - hue(color)).norm(), 0.2);

  Eigen::Matrix3Xd ends(3, 2);
  ends << -0.1, 0.1, -0.05, 0.05, 1, 1;
  lines.addLines(ends, color, 6);
  EXPECT_LT((seenAt(lines, {0, 0, 1}) - hue(color)).norm(), 0.2);

  boxes.addBoxes({{{0, 0, 1}, {0.2, 0.1, 1.3}}}, color, 6);
  EXPECT_LT((seenAt(boxes, {0.1, 0, 1}) - hue(color)).norm(), 0.2);
  EXPECT_LT((seenAt(boxes, {0.2, 0.05, 1}) - hue(color)).norm(), 0.2);
  EXPECT_EQ(seenAt(boxes, {0.1, 0.05, 1}), hue(PAPER));

  markers.addPoints(ends, color, 9);
  EXPECT_LT((seenAt(markers, ends.col(1)) - hue(color)).norm(), 0.2);
}

TEST(Snapshot, ClearEmptiesTheScene) {
  SnapshotRenderer renderer(bareOptions());
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1)}));
  renderer.clear();
  EXPECT_THROW(renderer.render(), Exception);
  EXPECT_EQ(renderer.getOptions().width, 320);
}
