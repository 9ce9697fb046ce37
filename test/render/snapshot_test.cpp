// SPDX-License-Identifier: BSD-3-Clause
// What is in the picture, held against the mathematics of the camera.
#include "pcl_sq/visualization/snapshot_renderer.h"

#include "pcl_sq/exception.h"
#include "random_superquadric.h"
#include "snapshot_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

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

TEST(Snapshot, PicturesAreRepeatable) {
  SnapshotRenderer renderer(bareOptions());
  renderer.addModel(modelOf({ballAt(0, 0, 1, 0.1), ballAt(0.1, 0, 1, 0.1)}));
  EXPECT_EQ(renderer.render().rgb, renderer.render().rgb);
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
