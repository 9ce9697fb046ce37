// SPDX-License-Identifier: BSD-3-Clause
// Points without an image: from where they may have been seen, and what they tell.
#include "pcl_sq/object_view.h"

#include "surface_cloud.h"
#include "view_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(ObserveObject, ViewpointInsideTheObjectIsLeftOutWithANote) {
  Random random(8);
  const Superquadric s = random.superquadric();
  const auto surface = sampleUniform(s, 500);
  Eigen::Matrix3Xf points(3, 500);
  for (int i = 0; i < 500; ++i)
    points.col(i) = surface[std::size_t(i)].cast<float>();
  ViewOptions view;
  view.viewpoint = s.center;
  ObservedObject observed;
  std::string why;
  ASSERT_TRUE(observeObject(points, 500, 1, {}, view, observed, &why)) << why;
  EXPECT_EQ(observed.outline, OutlineSource::NONE);
  ASSERT_EQ(observed.notes.size(), 1u);
  EXPECT_NE(observed.notes[0].find("inside the object"), std::string::npos);
}

TEST(ObserveObject, BarePointsOfOneViewFromTheOriginGetItAsTheirViewpoint) {
  const ViewScene scene = canScene();
  Eigen::Matrix3Xf object(3, scene.points.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < scene.points.cols(); ++i)
    if (scene.mask.cells[std::size_t(i)] && scene.points.col(i).allFinite())
      object.col(count++) = scene.points.col(i);
  object.conservativeResize(3, count);
  const auto outline = [](const Eigen::Matrix3Xf& points) {
    ObservedObject observed;
    EXPECT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, observed));
    EXPECT_EQ(observed.notes.size(), observed.hasCamera() ? 1u : 0u);
    return observed.outline;
  };
  EXPECT_EQ(outline(object), OutlineSource::POINTS);
  // its own mirror image behind it: seen all around
  Eigen::Matrix3Xf around(3, 2 * count);
  const float back = object.row(2).maxCoeff();
  around << object, object;
  around.rightCols(count).row(2) = 2.0f * back - object.row(2).array();
  EXPECT_EQ(outline(around), OutlineSource::NONE);
}

TEST(ObserveObject, BarePointsOfOneSideGetACameraOnThatSide) {
  ViewScene can = canScene(), box;
  box.addUpright({0.06, 0.04, 0.09}, 0.1, 0.1, 0.09);
  box.render(0.001);
  Random random(12);
  for (const ViewScene* scene : {&can, &box}) {
    Eigen::Matrix3Xf object(3, scene->points.cols());
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < scene->points.cols(); ++i)
      if (scene->mask.cells[std::size_t(i)])
        object.col(count++) = scene->points.col(i);
    object.conservativeResize(3, count);
    for (int turn = 0; turn < 25; ++turn) { // a robot's frame, anywhere
      const Eigen::Matrix3f rotation = random.rotation().cast<float>();
      Eigen::Matrix3Xf moved = rotation * object;
      moved.colwise() += Eigen::Vector3f(0.1f, -0.2f, 0.05f) - moved.rowwise().mean();
      ObservedObject observed;
      ASSERT_TRUE(observeObject(moved, int(count), 1, {}, {}, observed));
      ASSERT_EQ(observed.outline, OutlineSource::POINTS);
      EXPECT_NE(observed.notes.at(0).find("one side"), std::string::npos);
      const Eigen::Vector3d middle = moved.rowwise().mean().cast<double>();
      const Eigen::Vector3d truly =
          -(rotation * object.rowwise().mean()).cast<double>().normalized();
      const Eigen::Vector3d guessed = (observed.camera.center - middle).normalized();
      EXPECT_GT(guessed.dot(truly), 0.95);
    }
  }
}

TEST(ObserveObject, PointsAllAroundGetNoCamera) {
  Random random(13);
  for (int i = 0; i < 20; ++i) {
    Superquadric s = random.superquadric();
    for (double& a : s.semi_axes)
      a = random.uniform(0.03, 0.1);
    const Eigen::Matrix3Xf points =
        surfaceCloud(s, 2000, unsigned(i), 0.01 * s.semi_axes.minCoeff()).cast<float>();
    ObservedObject observed;
    ASSERT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, observed));
    EXPECT_EQ(observed.outline, OutlineSource::NONE) << s.semi_axes.transpose();
  }
}

TEST(ObserveObject, BarePointsThatErrTogetherCountForFewer) {
  ViewScene scene;
  scene.addUpright({0.05, 0.05, 0.08}, 0.2, 1.0, 0.08);
  scene.render();
  Random random(14);
  std::vector<Eigen::Vector2d> phases; // waves over the image, a few pixels long
  for (int k = 0; k < 40; ++k)
    phases.push_back(0.6 * Eigen::Vector2d(random.normal(), random.normal()));
  const auto effective = [&](bool together) {
    std::vector<Eigen::Vector3f> object;
    for (int c = 0; c < scene.points.cols(); ++c) {
      if (!scene.mask.cells[std::size_t(c)])
        continue;
      const Eigen::Vector2d pixel(c % scene.width, c / scene.width);
      double error = random.normal(1.0);
      if (together) {
        error = 0.0;
        for (std::size_t k = 0; k < phases.size(); ++k)
          error += std::sin(phases[k].dot(pixel) + double(k)) / std::sqrt(20.0);
      }
      const Eigen::Vector3d ray = scene.camera.ray(pixel);
      object.push_back(scene.points.col(c) + (0.001 * error * ray).cast<float>());
    }
    Eigen::Matrix3Xf points(3, Eigen::Index(object.size()));
    for (std::size_t i = 0; i < object.size(); ++i)
      points.col(Eigen::Index(i)) = object[i];
    ObservedObject observed;
    EXPECT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, observed));
    EXPECT_EQ(observed.outline, OutlineSource::POINTS);
    return observed.effective_points / double(observed.points.cols());
  };
  EXPECT_EQ(effective(false), 1.0);
  EXPECT_LT(effective(true), 0.5);
}
