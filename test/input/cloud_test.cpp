// SPDX-License-Identifier: BSD-3-Clause
// From what a file holds to the cloud that programs use.
#include "file_bytes.h"
#include "files/cloud_io.h"
#include "input/sample_surface.h"
#include "report/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Points in a box of a given middle and half size. */
app::Shape box(const Eigen::Vector3d& middle, double half, std::size_t count = 500) {
  std::mt19937 random(1);
  app::Shape shape;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p;
    for (double& value : p)
      value = half * (random() / 2147483648.0 - 1.0);
    shape.points.push_back(middle + p);
  }
  return shape;
}

std::string allNotes(const app::LoadedCloud& loaded) {
  std::string text;
  for (const std::string& note : loaded.notes)
    text += note + "\n";
  return text;
}

const Eigen::Vector3d SENSOR_FRAME(0.1, 0.0, 0.7);

} // namespace

TEST(Cloud, UnitsBecomeMetres) {
  for (const auto& [unit, length] : {std::pair<std::string, double>{"mm", 1e-3},
                                     {"cm", 1e-2},
                                     {"m", 1.0},
                                     {"in", 0.0254}}) {
    app::CloudOptions options;
    options.unit = unit;
    app::Shape shape = box({0, 0, 2}, 1.0);
    const Eigen::Vector3d first = shape.points[0];
    shape.origin = {0, 0, 1};
    const app::LoadedCloud loaded = app::makeCloud(shape, options);
    EXPECT_NEAR(
        ((*loaded.cloud)[0].getVector3fMap().cast<double>() - length * first).norm(),
        0.0,
        1e-6 * length);
    EXPECT_NEAR(loaded.cloud->sensor_origin_.z(), length, 1e-7);
    EXPECT_TRUE(loaded.offset.isZero());
  }
}

TEST(Cloud, TheFilesOwnUnitIsUsedAndNotContradicted) {
  app::Shape shape = box({0, 0, 650}, 60.0);
  shape.unit = "mm";
  app::CloudOptions options;
  const app::LoadedCloud loaded = app::makeCloud(shape, options);
  EXPECT_NEAR((*loaded.cloud)[0].z, 1e-3 * shape.points[0].z(), 1e-6);
  EXPECT_TRUE(tells(allNotes(loaded), {"the unit is mm, as the file's header says"}));
  options.unit = "mm";
  EXPECT_TRUE(app::makeCloud(shape, options).notes.empty());
  options.unit = "m"; // asked for, not taken for granted
  EXPECT_THROW((void)app::makeCloud(shape, options), app::Failure);
  options.unit = "in";
  try {
    (void)app::makeCloud(shape, options);
    ADD_FAILURE() << "two units";
  } catch (const app::Failure& failure) {
    EXPECT_TRUE(tells(failure.what(), {"unit is mm", "--unit in", "leave --unit out"}));
  }
}

TEST(Cloud, ZerosAreMissingInListsAndImages) {
  for (const bool image : {false, true}) {
    app::Shape shape = box(SENSOR_FRAME, 0.2);
    for (std::size_t i = 0; i < 100; ++i)
      shape.points[5 * i].setZero();
    if (image) {
      shape.width = 50;
      shape.height = 10;
    }
    const app::LoadedCloud loaded = app::makeCloud(shape, {});
    EXPECT_EQ(loaded.finite_points, 400u);
    EXPECT_EQ(loaded.cloud->size(), 500u);
    EXPECT_EQ(loaded.cloud->isOrganized(), image);
    EXPECT_TRUE(std::isnan((*loaded.cloud)[0].x));
    EXPECT_TRUE(tells(allNotes(loaded), {"100 points at 0 0 0"}));
  }
  // one point in the origin may be one
  app::Shape shape = box({0, 0, 0}, 0.2);
  shape.points[7].setZero();
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 500u);
}

TEST(Cloud, FarValuesThatManyPointsShareAreMissing) {
  for (const double far : {10.0, 65.535, 10000.0, -10000.0, 3.4e38, 1e30})
    for (const bool ray : {false, true}) {
      app::Shape shape = box(SENSOR_FRAME, 0.2);
      for (std::size_t i = 0; i < 100; ++i)
        shape.points[5 * i] = {ray ? far * 1e-3 * double(i) : 0.0, 0.0, far};
      const app::LoadedCloud loaded = app::makeCloud(shape, {});
      EXPECT_EQ(loaded.finite_points, 400u) << far << " " << ray;
      EXPECT_TRUE(tells(allNotes(loaded), {"100 points with z = "})) << far;
    }
  app::Shape shape = box(SENSOR_FRAME, 0.2); // two markers
  for (std::size_t i = 0; i < 50; ++i) {
    shape.points[i] = {-999, -999, -999};
    shape.points[100 + i] = {0, 0, 8000};
  }
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 400u);
}

TEST(Cloud, ManyPointsAtOnePlaceAreMissingHoweverNear) {
  for (const Eigen::Vector3d& marker :
       {Eigen::Vector3d(0, 0, -1), {-1, -1, -1}, {0, 0, 4}, {0.1, 0, 0.7}})
    for (const std::size_t step : {1u, 5u}) {
      app::Shape shape = box(SENSOR_FRAME, 0.2); // most are missing, or few
      for (std::size_t i = 0; i < 450; i += step)
        shape.points[i] = marker;
      const app::LoadedCloud loaded = app::makeCloud(shape, {});
      EXPECT_EQ(loaded.finite_points, step == 1 ? 50u : 410u) << marker.transpose();
      EXPECT_TRUE(tells(allNotes(loaded), {" points ", " taken as missing"}));
    }
  app::Shape shape = box(SENSOR_FRAME, 0.2); // two markers, one of them of rays
  for (std::size_t i = 0; i < 50; ++i) {
    shape.points[i] = {-1, -1, -1};
    shape.points[100 + i] = {0.01 * double(i), 0, 8};
  }
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 400u);
}

TEST(Cloud, PointsThatMeetAsOthersDoAreNotMissing) {
  app::Shape shape = box(SENSOR_FRAME, 0.2);
  for (std::size_t i = 1; i < 6; ++i) // a few doubles
    shape.points[i] = shape.points[0];
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 500u);
  shape = box(SENSOR_FRAME, 0.2);
  for (int i = 0; i < 5; ++i) // joined with itself, again and again
    shape.points.insert(shape.points.end(), shape.points.begin(), shape.points.end());
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 32u * 500u);
  shape = box(SENSOR_FRAME, 0.2, 20000);
  for (Eigen::Vector3d& p : shape.points) // in steps of five centimetres
    p = (20.0 * p).array().round() / 20.0;
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 20000u);
}

TEST(Cloud, WallsAndStraysAreNotMissing) {
  app::Shape shape = box(SENSOR_FRAME, 0.2); // a wall of exact numbers behind
  for (std::size_t i = 0; i < 100; ++i)
    shape.points[i] = {0.01 * double(i), 0.1, 1.5};
  EXPECT_EQ(app::makeCloud(shape, {}).finite_points, 500u);
  shape = box(SENSOR_FRAME, 0.2);
  shape.points[0] = {0, 0, 100};
  const app::LoadedCloud loaded = app::makeCloud(shape, {});
  EXPECT_EQ(loaded.finite_points, 500u);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(Cloud, GeoreferencedPointsKeepTheirDigits) {
  const Eigen::Vector3d place(451234.125, 5412345.25, 312.25);
  app::Shape shape = box(place, 0.05);
  shape.points[3].setZero(); // a stray does not hide it
  const app::LoadedCloud loaded = app::makeCloud(shape, {});
  EXPECT_EQ(loaded.offset, Eigen::Vector3d(451234, 5412345, 312));
  for (std::size_t i = 4; i < shape.points.size(); ++i) {
    const Eigen::Vector3d back =
        (*loaded.cloud)[i].getVector3fMap().cast<double>() + loaded.offset;
    ASSERT_NEAR((back - shape.points[i]).norm(), 0.0, 1e-6);
  }
  EXPECT_TRUE(loaded.cloud->sensor_origin_.head<3>().isZero());
  // clouds of sensors and robots stay where they are
  for (const double distance : {0.5, 3.0})
    EXPECT_TRUE(app::makeCloud(box({0, 0, distance}, 0.05), {}).offset.isZero());
}

TEST(Cloud, FarCoordinatesInSinglePrecisionAreToldToBeCoarse) {
  app::Shape shape = box({451234.125, 5412345.25, 312.25}, 0.05);
  EXPECT_FALSE(tells(allNotes(app::makeCloud(shape, {})), {"single precision"}));
  for (Eigen::Vector3d& p : shape.points)
    p = p.cast<float>().cast<double>();
  EXPECT_TRUE(tells(allNotes(app::makeCloud(shape, {})),
                    {"single precision", "resolves them to 0.5 only", "doubles"}));
  // a town is as far and larger than the steps; a thing is near
  shape = box({451234, 5412345, 312}, 200.0);
  app::Shape near = box(SENSOR_FRAME, 0.2);
  for (app::Shape* floats : {&shape, &near}) {
    for (Eigen::Vector3d& p : floats->points)
      p = p.cast<float>().cast<double>();
    EXPECT_FALSE(tells(allNotes(app::makeCloud(*floats, {})), {"single precision"}));
  }
  near.points.resize(1); // of no size at all
  EXPECT_FALSE(tells(allNotes(app::makeCloud(near, {})), {"single precision"}));
}

TEST(Cloud, SurfacesAreSampledByAreaAndSaid) {
  // one face of four times the other's area
  app::Shape shape = app::readShape(
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 5\nv 1 0 5\nv 1 1 5\nv 0 1 5\n"
      "f 1 2 3 4\nf 5 6 7 8\n",
      ".obj");
  const auto points = app::sampleSurface(shape, 1000);
  ASSERT_EQ(points.size(), 1000u);
  EXPECT_EQ(points, app::sampleSurface(shape, 1000));
  std::size_t large = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    if (p.z() == 0.0) {
      ++large;
      mean += p;
    }
  EXPECT_NEAR(double(large), 800.0, 1.0);
  EXPECT_NEAR((mean / double(large) - Eigen::Vector3d(1, 1, 0)).norm(), 0.0, 0.06);
  app::CloudOptions options;
  options.samples = 700;
  options.unit = "cm";
  const app::LoadedCloud loaded = app::makeCloud(shape, options);
  EXPECT_EQ(loaded.cloud->size(), 700u);
  EXPECT_TRUE(tells(allNotes(loaded), {"2 faces sampled with 700 points"}));
  EXPECT_LE(loaded.cloud->points[0].getVector3fMap().maxCoeff(), 0.05f);
  // faces without area are no surface
  EXPECT_THROW(
      (void)app::makeCloud(app::readShape("v 0 0 0\nv 1 1 1\nf 1 2 2\n", ".obj"), {}),
      app::Failure);
}

TEST(Printable, KeepsTextAndNothingElse) {
  EXPECT_EQ(app::printable("a cup.pcd"), "a cup.pcd");
  EXPECT_EQ(app::printable("T\xc3\xa4sse \xe2\x82\xac \xf0\x9f\x8d\xb5"),
            "T\xc3\xa4sse \xe2\x82\xac \xf0\x9f\x8d\xb5");
  EXPECT_EQ(app::printable("a\x1b[31m\nb\x7f"), "a?[31m?b?");
  EXPECT_EQ(app::printable("\xff\xc3"), "??");
  EXPECT_EQ(app::printable("\xc0\xaf\xed\xa0\x80"), "?????"); // overlong, surrogate
  EXPECT_EQ(app::printable("\xc2\x9b"), "??");                // a control in UTF-8
  EXPECT_EQ(app::printable("abcdef", 3), "abc...");
}
