// SPDX-License-Identifier: BSD-3-Clause
// Bare points of one side of something: no outline, and perhaps no camera.
#include "fit_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief What a camera at the origin sees of a dumbbell of known sizes. */
ViewScene dumbbell(const Eigen::Matrix3d& rotation, double radius, double half_length) {
  ViewScene scene;
  scene.width = 240;
  scene.height = 180;
  scene.camera.fx = scene.camera.fy = 500.0;
  scene.camera.cx = 119.5;
  scene.camera.cy = 89.5;
  scene.table.offset = 3.0; // none in sight
  Superquadric rod;
  rod.rotation = rotation;
  rod.center = {0.0, 0.0, 0.6};
  rod.semi_axes = {0.012, 0.012, half_length};
  rod.epsilon1 = 0.2;
  scene.object.parts.push_back(rod);
  for (const double end : {-half_length, half_length}) {
    Superquadric ball;
    ball.rotation = rotation;
    ball.center = rod.center + end * rotation.col(2);
    ball.semi_axes.setConstant(radius);
    scene.object.parts.push_back(ball);
  }
  scene.render(0.0015);
  return scene;
}

Eigen::Matrix3Xf seen(const ViewScene& scene) {
  Eigen::Matrix3Xf points(3, scene.mask.count());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < scene.points.cols(); ++i)
    if (scene.mask.cells[std::size_t(i)])
      points.col(count++) = scene.points.col(i);
  return points;
}

ObjectFit fitBare(const Eigen::Matrix3Xf& points, const ViewOptions& view) {
  ObservedObject observed;
  EXPECT_TRUE(observeObject(points, int(points.cols()), 1, {}, view, observed));
  return fitObject(observed);
}

bool allSolid(const MultiSuperquadric& model) {
  return std::none_of(model.parts.begin(), model.parts.end(), [](const auto& s) {
    return s.isHollow() || s.isBent();
  });
}

} // namespace

TEST(BareView, DumbbellIsThreeSolidsAndNoBentRodOrVessel) {
  constexpr int VIEWS = 10;
  int right = 0; // seven of forty are not, five of them slanting from 1.17 to 1.37
  for (int i = 0; i < VIEWS; ++i) {
    const double tilt = 1.45 + 0.05 * i;
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d(1.0, 0.5, 0.0).normalized())
            .toRotationMatrix();
    const ViewScene scene = dumbbell(rotation, 0.02 * tilt, 0.08);
    ViewOptions view;
    view.viewpoint = scene.camera.center;
    const ObjectFit fit = fitBare(seen(scene), view);
    right += fit.model.size() == 3 && allSolid(fit.model) &&
             overlap(fit.model, scene.object) > 0.8;
  }
  EXPECT_GE(right, VIEWS - 2);
}

TEST(BareView, WhatStandsInARobotsFrameIsNotSeenFromItsOrigin) {
  Random random(32);
  const ViewScene scene = dumbbell(random.rotation(), 0.035, 0.08);
  const Eigen::Matrix3Xf points = seen(scene);
  for (const double turn : {1.6, 2.2, 3.0}) {
    // the origin lies before the points, but at their side or behind them
    Eigen::Isometry3d motion =
        Eigen::Translation3d(0.0, 0.0, 0.6) *
        Eigen::AngleAxisd(turn, Eigen::Vector3d(1.0, 0.5, 0.0).normalized()) *
        Eigen::Translation3d(0.0, 0.0, -0.6);
    const Eigen::Matrix3Xf moved = motion.cast<float>() * points;
    ObservedObject observed;
    ASSERT_TRUE(observeObject(moved, int(moved.cols()), 1, {}, {}, observed));
    ASSERT_TRUE(observed.hasCamera());
    EXPECT_FALSE(observed.viewpoint_known);
    const Eigen::Vector3d middle = motion * scene.object.parts[0].center;
    const Eigen::Vector3d camera = motion * scene.camera.center;
    EXPECT_GT((observed.camera.center - middle)
                  .normalized()
                  .dot((camera - middle).normalized()),
              0.95)
        << turn;
    const ObjectFit fit = fitObject(observed);
    EXPECT_TRUE(allSolid(fit.model)) << turn;
    EXPECT_EQ(fit.model.size(), 3u) << turn;
  }
}

TEST(BareView, WhatAVoxelGridHasThinnedIsStillTakenForItsCamerasFrame) {
  const ViewScene scene = dumbbell(Random(33).rotation(), 0.035, 0.08);
  const Eigen::Matrix3Xf points = seen(scene);
  // as pcl::VoxelGrid does: the mean of each cell's points
  std::map<std::array<int, 3>, std::pair<Eigen::Vector3f, int>> cells;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3i at = (points.col(i) / 0.004f).array().floor().cast<int>();
    auto& cell = cells
                     .emplace(std::array<int, 3>{at.x(), at.y(), at.z()},
                              std::pair(Eigen::Vector3f(0.0f, 0.0f, 0.0f), 0))
                     .first->second;
    cell.first += points.col(i);
    ++cell.second;
  }
  Eigen::Matrix3Xf thinned(3, Eigen::Index(cells.size()));
  Eigen::Index count = 0;
  for (const auto& [at, cell] : cells)
    thinned.col(count++) = cell.first / float(cell.second);
  ObservedObject observed;
  ASSERT_TRUE(observeObject(thinned, int(thinned.cols()), 1, {}, {}, observed));
  EXPECT_TRUE(observed.viewpoint_known);
  EXPECT_TRUE(observed.camera.center.isZero());
}
