// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/view_camera.h"

#include "pcl_sq/exception.h"
#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;

namespace {

constexpr int WIDTH = 640, HEIGHT = 480;
const Eigen::Vector3d CAMERA_UP = -Eigen::Vector3d::UnitY();

Eigen::Matrix3Xd someObject(unsigned seed) {
  test::Random random(seed);
  const Superquadric s = random.superquadric();
  Eigen::Matrix3Xd points(3, 200);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = random.surfacePoint(s);
  points.row(2).array() += 1.0; // in front of the camera
  return points;
}

Eigen::AlignedBox2d pictureOf(const ViewCamera& camera,
                              const Eigen::Matrix3Xd& points) {
  Eigen::AlignedBox2d box;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    box.extend(camera.project(points.col(i)).head<2>().eval());
  return box;
}

} // namespace

TEST(ViewCamera, FrontOfACameraFrameShowsXToTheRightAndYDown) {
  const Eigen::Matrix3Xd points = someObject(1);
  const ViewCamera camera(points, View::FRONT, CAMERA_UP, WIDTH, HEIGHT);
  EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(camera.up().isApprox(-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(camera.forward().isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(ViewCamera, RobotFramesWithZUpAreSeenAlongY) {
  const ViewCamera camera(
      someObject(1), View::FRONT, Eigen::Vector3d::UnitZ(), WIDTH, HEIGHT);
  EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(camera.forward().isApprox(Eigen::Vector3d::UnitY()));
}

TEST(ViewCamera, UpwardPointsAreHigherInEveryPictureButTheTopView) {
  const Eigen::Matrix3Xd points = someObject(2);
  test::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d up = random.direction();
    for (const View view : {View::FRONT, View::SIDE, View::ISO}) {
      const ViewCamera camera(points, view, up, WIDTH, HEIGHT);
      const Eigen::Vector3d p = points.col(0);
      const Eigen::Vector3d moved = camera.project(p + 0.01 * up) - camera.project(p);
      EXPECT_LT(moved.y(), 0.0) << toString(view);
      EXPECT_NEAR(moved.x(), 0.0, 1e-6) << toString(view);
    }
  }
}

TEST(ViewCamera, TopViewLooksDownWithTheFrontAtTheBottom) {
  const Eigen::Matrix3Xd points = someObject(2);
  const ViewCamera front(points, View::FRONT, CAMERA_UP, WIDTH, HEIGHT);
  const ViewCamera top(points, View::TOP, CAMERA_UP, WIDTH, HEIGHT);
  EXPECT_TRUE(top.forward().isApprox(-CAMERA_UP));
  EXPECT_TRUE(top.right().isApprox(front.right()));
  const Eigen::Vector3d p = points.col(0);
  EXPECT_GT(top.project(p - 0.01 * front.forward()).y(), top.project(p).y());
}

TEST(ViewCamera, SideAndIsoSeeTheRightHandSide) {
  const Eigen::Matrix3Xd points = someObject(2);
  const ViewCamera front(points, View::FRONT, CAMERA_UP, WIDTH, HEIGHT);
  const ViewCamera side(points, View::SIDE, CAMERA_UP, WIDTH, HEIGHT);
  const ViewCamera iso(points, View::ISO, CAMERA_UP, WIDTH, HEIGHT);
  EXPECT_TRUE(side.forward().isApprox(-front.right()));
  EXPECT_LT(iso.forward().dot(front.right()), -0.3);
  EXPECT_LT(iso.forward().dot(CAMERA_UP), -0.3);
  EXPECT_GT(iso.forward().dot(front.forward()), 0.3);
}

TEST(ViewCamera, AxesAreOrthonormalAndTheDepthGrowsAlongTheViewingDirection) {
  const Eigen::Matrix3Xd points = someObject(4);
  for (const View view :
       {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA}) {
    const ViewCamera camera(
        points, view, Eigen::Vector3d(0.2, -1.0, 0.1), WIDTH, HEIGHT);
    EXPECT_NEAR(camera.right().cross(camera.up()).dot(camera.forward()), -1.0, 1e-12);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d p = points.col(i);
      EXPECT_GT(camera.project(p).z(), 0.0);
      EXPECT_NEAR(camera.project(p + 0.1 * camera.forward()).z() -
                      camera.project(p).z(),
                  0.1,
                  1e-9);
      EXPECT_LT(camera.toEye(p).dot(camera.forward()), 0.0);
    }
  }
}

TEST(ViewCamera, TheObjectFillsTheRoomBetweenTheMargins) {
  const FrameMargins margins{0.1, 0.2, 0.15, 0.05};
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const View view :
         {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA}) {
      const Eigen::Matrix3Xd points = someObject(seed);
      const ViewCamera camera(points, view, CAMERA_UP, WIDTH, HEIGHT, margins);
      const Eigen::AlignedBox2d box = pictureOf(camera, points);
      EXPECT_GE(box.min().x(), 0.1 * WIDTH - 1e-6);
      EXPECT_LE(box.max().x(), 0.8 * WIDTH + 1e-6);
      EXPECT_GE(box.min().y(), 0.15 * HEIGHT - 1e-6);
      EXPECT_LE(box.max().y(), 0.95 * HEIGHT + 1e-6);
      EXPECT_NEAR(box.center().x(), 0.45 * WIDTH, 1e-6);
      EXPECT_NEAR(box.center().y(), 0.55 * HEIGHT, 1e-6);
      const bool fills_width = box.sizes().x() > 0.7 * WIDTH - 1e-6;
      const bool fills_height = box.sizes().y() > 0.8 * HEIGHT - 1e-6;
      EXPECT_TRUE(fills_width || fills_height) << toString(view);
    }
}

TEST(ViewCamera, CameraViewIsACutOutOfThePinholeImage) {
  const Eigen::Matrix3Xd points = someObject(5);
  const ViewCamera camera(points, View::CAMERA, CAMERA_UP, WIDTH, HEIGHT);
  ASSERT_TRUE(camera.perspective());
  EXPECT_TRUE(camera.position().isZero());
  // one scale and one offset take the sensor's image to the picture
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = points.col(i);
    const Eigen::Vector2d expected =
        camera.principalPoint() + camera.focalLength() * p.hnormalized();
    EXPECT_NEAR((camera.project(p).head<2>() - expected).norm(), 0.0, 1e-6);
  }
}

TEST(ViewCamera, CameraViewOfAnObjectBehindTheSensorIsRefused) {
  Eigen::Matrix3Xd points = someObject(5);
  points(2, 17) = 0.0;
  EXPECT_THROW(ViewCamera(points, View::CAMERA, CAMERA_UP, WIDTH, HEIGHT), Exception);
}

TEST(ViewCamera, PixelsPerMeterIsTheScaleOfThePicture) {
  const Eigen::Matrix3Xd points = someObject(6);
  const ViewCamera camera(points, View::ISO, CAMERA_UP, WIDTH, HEIGHT);
  const Eigen::Vector3d p = points.col(3);
  const Eigen::Vector3d moved = camera.project(p + 0.02 * camera.right());
  EXPECT_NEAR(moved.x() - camera.project(p).x(), 0.02 * camera.pixelsPerMeter(), 1e-6);
}

TEST(ViewCamera, TurntableHoldsTheObjectInOneFrameAllTheWayRound) {
  const FrameMargins margins{0.1, 0.2, 0.15, 0.05};
  for (const View view : {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA})
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Eigen::Matrix3Xd points = someObject(seed);
      Eigen::AlignedBox2d seen;
      double scale = 0.0;
      for (int i = 0; i < 36; ++i) {
        const ViewCamera camera = ViewCamera::turntable(
            points, view, CAMERA_UP, WIDTH, HEIGHT, margins, i * M_PI / 18);
        seen.extend(pictureOf(camera, points));
        if (i > 0) {
          EXPECT_NEAR(camera.pixelsPerMeter(), scale, 1e-6 * scale);
        }
        scale = camera.pixelsPerMeter();
      }
      EXPECT_GE(seen.min().x(), 0.1 * WIDTH - 1e-6);
      EXPECT_LE(seen.max().x(), 0.8 * WIDTH + 1e-6);
      EXPECT_GE(seen.min().y(), 0.15 * HEIGHT - 1e-6);
      EXPECT_LE(seen.max().y(), 0.95 * HEIGHT + 1e-6);
    }
}

TEST(ViewCamera, TurntableStartsAtItsViewAndTurnsAroundTheUpwardAxis) {
  const Eigen::Matrix3Xd points = someObject(7);
  const ViewCamera still(points, View::ISO, CAMERA_UP, WIDTH, HEIGHT);
  const auto turned = [&](double azimuth) {
    return ViewCamera::turntable(
        points, View::ISO, CAMERA_UP, WIDTH, HEIGHT, {}, azimuth);
  };
  EXPECT_TRUE(turned(0.0).forward().isApprox(still.forward()));
  EXPECT_TRUE(turned(2.0 * M_PI).forward().isApprox(still.forward()));
  const Eigen::Vector3d half = turned(M_PI).forward();
  EXPECT_NEAR(half.dot(CAMERA_UP), still.forward().dot(CAMERA_UP), 1e-12);
  EXPECT_NEAR(half.x(), -still.forward().x(), 1e-12);
  EXPECT_NEAR(half.z(), -still.forward().z(), 1e-12);
}

TEST(ViewCamera, APointALineAndAFarObjectHaveAFinitePicture) {
  Eigen::Matrix3Xd point(3, 1), line(3, 2);
  point << 1.0, 2.0, 3.0;
  line << 1.0, 1.0, 2.0, 2.0, 3.0, 4.0;
  Eigen::Matrix3Xd far = someObject(8);
  far.array() += 1e6;
  for (const View view : {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA})
    for (const Eigen::Matrix3Xd& points : {point, line, far}) {
      const ViewCamera camera(points, view, CAMERA_UP, WIDTH, HEIGHT);
      const Eigen::Vector3d pixel = camera.project(points.col(0));
      EXPECT_TRUE(pixel.allFinite()) << toString(view);
      EXPECT_GE(pixel.x(), 0.0);
      EXPECT_LE(pixel.x(), WIDTH);
      EXPECT_GE(pixel.y(), 0.0);
      EXPECT_LE(pixel.y(), HEIGHT);
    }
}

TEST(View, NamesAndValuesBelongTogether) {
  for (const View view :
       {View::FRONT, View::SIDE, View::TOP, View::ISO, View::CAMERA}) {
    View read = View::FRONT;
    EXPECT_TRUE(viewFromString(toString(view), &read));
    EXPECT_EQ(read, view);
  }
  View untouched = View::TOP;
  EXPECT_FALSE(viewFromString("Iso", &untouched));
  EXPECT_FALSE(viewFromString("", &untouched));
  EXPECT_EQ(untouched, View::TOP);
}
