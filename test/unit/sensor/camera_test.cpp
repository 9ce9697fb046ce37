// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/camera.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>

namespace pcl_sq {
namespace {

PinholeCamera turnedCamera() {
  PinholeCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 520.0;
  camera.fy = 515.0;
  camera.cx = 321.5;
  camera.cy = 238.25;
  camera.center = {0.3, -0.2, 0.1};
  camera.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  return camera;
}

TEST(PinholeCamera, RayOfAPointsPixelMeetsThePoint) {
  const PinholeCamera camera = turnedCamera();
  for (const Eigen::Vector3d& seen :
       {Eigen::Vector3d(0, 0, 1), {0.2, -0.1, 0.6}, {-0.4, 0.3, 2.5}}) {
    const Eigen::Vector3d p = camera.center + camera.rotation * seen;
    const Eigen::Vector3d towards = (p - camera.center).normalized();
    EXPECT_LT((camera.ray(camera.project(p)) - towards).norm(), 1e-12);
    EXPECT_NEAR(camera.depthOf(p), seen.z(), 1e-12);
  }
}

TEST(PinholeCamera, AtTheOriginItProjectsAsItsIntrinsicsDo) {
  PinholeCamera camera = turnedCamera();
  camera.center.setZero();
  camera.rotation.setIdentity();
  const CameraIntrinsics& intrinsics = camera;
  const Eigen::Vector3d p(0.1, -0.3, 0.8);
  EXPECT_EQ(camera.project(p), intrinsics.project(p));
  const Eigen::Vector2d pixel = intrinsics.project(p);
  EXPECT_LT((intrinsics.backProject(pixel.x(), pixel.y(), p.z()) - p).norm(), 1e-12);
}

TEST(PinholeCamera, SaysWhatIsWrongWithIt) {
  std::string why;
  EXPECT_TRUE(turnedCamera().isValid(&why)) << why;
  PinholeCamera flat = turnedCamera();
  flat.fy = 0.0;
  EXPECT_FALSE(flat.isValid(&why));
  EXPECT_EQ(why, "the focal length must be positive");
  PinholeCamera lost = turnedCamera();
  lost.center.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lost.isValid(&why));
  EXPECT_EQ(why, "the camera's pose must be finite");
  PinholeCamera other = turnedCamera();
  other.cx = 4000.0;
  EXPECT_FALSE(other.isValid(&why));
  EXPECT_NE(why.find("far outside of an image of 640 x 480"), std::string::npos) << why;
}

TEST(PinholeCamera, SeesWhatItLooksAtAlongItsAxis) {
  const Eigen::Vector3d center(1, 2, 3), target(0.5, 2.5, 3.5);
  const PinholeCamera camera = PinholeCamera::lookingAt(center, target, 500.0);
  EXPECT_LT(camera.project(target).norm(), 1e-9); // its principal point is (0, 0)
  EXPECT_NEAR(camera.depthOf(target), (target - center).norm(), 1e-12);
  EXPECT_NEAR(camera.rotation.determinant(), 1.0, 1e-12);
}

} // namespace
} // namespace pcl_sq
