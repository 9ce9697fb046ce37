// SPDX-License-Identifier: BSD-3-Clause
// Outlines of masks and their lines, which are planes that touch the body.
#include "pcl_sq/silhouette.h"

#include "pcl_sq/triangle_mesh.h"
#include "view_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

PinholeCamera someCamera() {
  PinholeCamera camera;
  camera.fx = 800.0;
  camera.fy = 780.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  return camera;
}

/** \brief The outline of a body as its projected surface. */
std::vector<ContourPoint> projected(const Superquadric& s,
                                    const PinholeCamera& camera) {
  std::vector<ContourPoint> contour;
  for (const Eigen::Vector3d& p : meshSuperquadric(s, 120).vertices) {
    ContourPoint point;
    point.pixel = camera.project(p);
    contour.push_back(point);
  }
  return contour;
}

Superquadric inFront(Random& random) {
  Superquadric s = random.superquadric();
  s.center.z() += 1.0;
  return s;
}

} // namespace

TEST(Silhouette, TangentPlanesOfAnExactOutlineTouchTheBody) {
  Random random(1);
  const PinholeCamera camera = someCamera();
  for (int i = 0; i < 30; ++i) {
    const Superquadric s = inFront(random);
    const auto lines = silhouetteLines(projected(s, camera), 32);
    ASSERT_EQ(lines.size(), 32u);
    for (const SilhouetteLine& line : lines) {
      const TangentPlane plane = tangentPlane(camera, line, 1.0, s.center.z());
      // the mesh lies inside the body: the body sticks out, by less than half a pixel
      EXPECT_GT(plane.residual(s), -1e-9);
      EXPECT_LT(plane.residual(s), 0.5 * plane.sigma);
    }
  }
}

TEST(Silhouette, PlanesOfARenderedMaskTouchTheBodyWithinAPixel) {
  for (const double e : {0.2, 1.0, 1.6}) {
    ViewScene scene;
    scene.addUpright({0.05, 0.04, 0.06}, e, 1.0, 0.06);
    scene.render();
    const auto lines = silhouetteLines(contourOf(scene.mask), 48);
    EXPECT_EQ(lines.size(), 48u);
    for (const SilhouetteLine& line : lines) {
      const TangentPlane plane = tangentPlane(scene.camera, line, 1.0, 1.0);
      EXPECT_LT(std::abs(plane.residual(scene.object.parts[0])), 1.2 * plane.sigma);
    }
  }
}

TEST(Silhouette, StraightSideIsTangentThoughTheOutlineIsLostBeyondItsEnd) {
  std::vector<ContourPoint> contour;
  for (int y = 0; y <= 60; ++y)
    for (const int x : {0, 20})
      contour.push_back({{double(x), double(y)}, true});
  for (int x = 0; x <= 20; ++x) {
    contour.push_back({{double(x), 60.0}, true});
    contour.push_back({{double(x), 0.0}, false}); // it goes on beyond that end
  }
  const auto lines = silhouetteLines(contour, 48);
  const auto holds = [&lines](double degrees) {
    const double angle = degrees * M_PI / 180.0;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    return std::any_of(lines.begin(), lines.end(), [&](const SilhouetteLine& line) {
      return line.direction.dot(direction) > 0.9999;
    });
  };
  for (const double degrees : {0.0, 180.0, 7.5, 90.0})
    EXPECT_TRUE(holds(degrees)) << degrees;
  for (const double degrees : {-7.5, 187.5, -45.0, 270.0})
    EXPECT_FALSE(holds(degrees)) << degrees;
}

TEST(Silhouette, CameraInAnyPoseGivesTheSamePlanesInItsFrame) {
  Random random(2);
  const PinholeCamera camera = someCamera();
  PinholeCamera moved = camera;
  moved.rotation = random.rotation();
  moved.center = {0.3, -0.2, 0.5};
  SilhouetteLine line;
  line.direction = Eigen::Vector2d(0.6, 0.8);
  line.offset = 300.0;
  const TangentPlane a = tangentPlane(camera, line, 1.0, 1.0);
  const TangentPlane b = tangentPlane(moved, line, 1.0, 1.0);
  EXPECT_LT((moved.rotation * a.normal - b.normal).norm(), 1e-12);
  EXPECT_NEAR(b.normal.dot(moved.center), b.offset, 1e-12);
}

TEST(Silhouette, ProjectionAndRayAreInverse) {
  Random random(3);
  PinholeCamera camera =
      PinholeCamera::lookingAt({1.0, 2.0, -0.5}, {0.0, 0.1, 0.3}, 500.0);
  EXPECT_NEAR(camera.rotation.determinant(), 1.0, 1e-12);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.3);
    const Eigen::Vector3d ray = camera.ray(camera.project(p));
    EXPECT_LT(ray.cross((p - camera.center).normalized()).norm(), 1e-12);
  }
}

TEST(Silhouette, ArcsAtTheImageBorderAreLeftOut) {
  CellMask mask(60, 60);
  for (int y = 20; y < 40; ++y)
    for (int x = 0; x < 30; ++x) // cut by the left border
      mask.set(x, y);
  const auto lines = silhouetteLines(contourOf(mask), 36);
  EXPECT_FALSE(lines.empty());
  EXPECT_LT(lines.size(), 36u);
  for (const SilhouetteLine& line : lines)
    EXPECT_GT(line.direction.x(), -0.2) << "a line at the border was kept";
}

TEST(Silhouette, ForeignArcsAreLeftOut) {
  CellMask mask(60, 60);
  for (int y = 20; y < 40; ++y)
    for (int x = 20; x < 40; ++x)
      mask.set(x, y);
  const auto contour = contourOf(mask, [](int, int y) { return y > 37; });
  for (const SilhouetteLine& line : silhouetteLines(contour, 36))
    EXPECT_LT(line.direction.y(), 0.2);
}

TEST(Silhouette, HullHoldsAllPointsAndTooFewPointsHaveNoLines) {
  Random random(4);
  std::vector<ContourPoint> contour(200);
  for (ContourPoint& p : contour)
    p.pixel = {random.uniform(0, 100), random.uniform(0, 100)};
  const auto hull = convexHull(contour);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d a = hull[i].pixel;
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()].pixel - a;
    for (const ContourPoint& p : contour)
      EXPECT_GE(edge.x() * (p.pixel - a).y() - edge.y() * (p.pixel - a).x(), -1e-9);
  }
  contour.resize(2);
  EXPECT_TRUE(silhouetteLines(contour, 12).empty());
  EXPECT_TRUE(silhouetteLines({}, 12).empty());
}

TEST(CellMask, BoundingRectHoldsTheSetCells) {
  CellMask mask(20, 12);
  EXPECT_EQ(boundingRect(mask).area(), 0);
  mask.set(7, 3);
  EXPECT_EQ(boundingRect(mask), (CellRect{7, 3, 1, 1}));
  mask.set(19, 11);
  mask.set(2, 5);
  EXPECT_EQ(boundingRect(mask), (CellRect{2, 3, 18, 9}));
}
