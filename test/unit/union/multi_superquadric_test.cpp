// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/model_io.h"
#include "pcl_sq/multi_superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

MultiSuperquadric randomUnion(Random& random, int parts) {
  MultiSuperquadric m;
  for (int k = 0; k < parts; ++k)
    m.parts.push_back(random.superquadric());
  return m;
}

ModelFile sampleFile() {
  Random random(30);
  ModelFile file;
  file.model = randomUnion(random, 3);
  file.statistics = {{100, 0.1, 0.001, "COST_CHANGE_TOO_SMALL"}, {}, {7, 1, 2, "x"}};
  file.frame = "camera";
  file.distortion = 0.125;
  file.rms_distance = 1e-3;
  file.input_path = "cup \"a\".pcd";
  file.input_points = 23000;
  file.finite_points = 22998;
  file.options_json = R"({"fit":"paper"})";
  file.timings_ms = {{"load", 1.5}, {"fit", 2.25}};
  file.extra_json = R"({"report":{"stage":1}})";
  return file;
}

} // namespace

TEST(MultiSuperquadric, PointIsInsideIfItIsInsideAnyPart) {
  Random random(31);
  const MultiSuperquadric m = randomUnion(random, 3);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random.pointNear(m.parts[i % 3]);
    bool any = false;
    for (const Superquadric& part : m.parts)
      any = any || part.insideOutside(p) <= 1.0;
    EXPECT_EQ(m.contains(p), any);
    EXPECT_EQ(m.euclideanDistance(p) <= 0.0, any);
  }
}

TEST(MultiSuperquadric, DistancesOfManyPointsAreThoseOfEach) {
  Random random(36);
  MultiSuperquadric m = randomUnion(random, 6);
  m.parts[0].kx = 0.4;
  m.parts[1].rim = 0.5;
  m.parts[1].wall = 0.05 * m.parts[1].semi_axes.minCoeff();
  m.parts[2].bend = 0.5 / m.parts[2].semi_axes.z();
  m.parts[3].center.x() += 5.0; // far from the others
  Eigen::Matrix3Xd points(3, 300);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = random.pointNear(m.parts[i % 6]);
  for (const unsigned int threads : {1U, 3U, 0U, 1000000000U}) {
    const Eigen::VectorXd distances = m.euclideanDistances(points, threads);
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      EXPECT_NEAR(distances[i], m.euclideanDistance(points.col(i)), 1e-9);
  }
  EXPECT_EQ(MultiSuperquadric().euclideanDistances(points).minCoeff(),
            std::numeric_limits<double>::infinity());
}

TEST(MultiSuperquadric, SupportAndBoxEncloseEverySurfacePoint) {
  Random random(32);
  const MultiSuperquadric m = randomUnion(random, 4);
  const Eigen::AlignedBox3d box = m.boundingBox();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = random.surfacePoint(m.parts[i % 4]);
    const Eigen::Vector3d n = random.direction();
    EXPECT_LE(n.dot(p), m.support(n) + 1e-9);
    EXPECT_LT(box.exteriorDistance(p), 1e-9);
  }
}

TEST(MultiSuperquadric, DistortionIsEquationSevenAndScalesFromMetresToMillimetres) {
  Random random(33);
  MultiSuperquadric one = randomUnion(random, 1);
  Eigen::Matrix3Xd points(3, 50);
  double expected = 0.0;
  for (int i = 0; i < 50; ++i) {
    points.col(i) = random.pointNear(one.parts[0]);
    const double d = one.parts[0].gauge(points.col(i)) - 1.0;
    expected += std::sqrt(one.parts[0].semi_axes.prod()) * d * d / 50.0;
  }
  EXPECT_NEAR(one.distortion(points), expected, 1e-4 * expected);
  // sqrt(a1 a2 a3) in millimetres is sqrt(1e9) times that in metres
  EXPECT_NEAR(
      one.distortion(points, 0.001), expected * std::sqrt(1e9), 1e-4 * expected * 1e5);
  EXPECT_EQ(one.distortion(Eigen::Matrix3Xd(3, 0)), 0.0);
}

TEST(MultiSuperquadric, RmsDistanceOfAShiftedSphereIsTheShift) {
  MultiSuperquadric sphere;
  sphere.parts.resize(1);
  Eigen::Matrix3Xd points(3, 100);
  Random random(34);
  for (int i = 0; i < 100; ++i)
    points.col(i) = random.direction() * (i % 2 ? 1.01 : 0.99);
  EXPECT_NEAR(sphere.rmsDistance(points), 0.01, 1e-6);
}

TEST(MultiSuperquadric, EmptyUnionContainsNothing) {
  const MultiSuperquadric none;
  EXPECT_FALSE(none.contains(Eigen::Vector3d::Zero()));
  EXPECT_TRUE(none.boundingBox().isEmpty());
  EXPECT_EQ(none.rmsDistance(Eigen::Matrix3Xd::Zero(3, 2)), 0.0);
}

TEST(ModelIo, WrittenModelReadsBackToTheLastBit) {
  const ModelFile file = sampleFile();
  ModelFile back;
  std::string why;
  ASSERT_TRUE(fromJson(toJson(file), back, &why)) << why;
  ASSERT_EQ(back.model.size(), file.model.size());
  for (std::size_t i = 0; i < file.model.size(); ++i) {
    EXPECT_EQ(back.model.parts[i].center, file.model.parts[i].center);
    EXPECT_EQ(back.model.parts[i].rotation, file.model.parts[i].rotation);
    EXPECT_EQ(back.model.parts[i].semi_axes, file.model.parts[i].semi_axes);
    EXPECT_EQ(back.model.parts[i].epsilon1, file.model.parts[i].epsilon1);
    EXPECT_EQ(back.model.parts[i].epsilon2, file.model.parts[i].epsilon2);
    EXPECT_EQ(back.statistics[i].points, file.statistics[i].points);
  }
  EXPECT_EQ(toJson(back), toJson(file));
  EXPECT_EQ(toJson(file, -1).find('\n'), std::string::npos);
}

TEST(ModelIo, TapersAreKeptAndRaiseTheVersion) {
  ModelFile file = sampleFile();
  EXPECT_NE(toJson(file).find("\"version\": 1"), std::string::npos) << "none tapers";
  file.model.parts[0].kx = 0.2;
  file.model.parts[0].ky = -0.3;
  const std::string text = toJson(file);
  EXPECT_NE(text.find("\"version\": 2"), std::string::npos);
  ModelFile back;
  std::string why;
  ASSERT_TRUE(fromJson(text, back, &why)) << why;
  EXPECT_EQ(back.model.parts[0].kx, 0.2);
  EXPECT_EQ(back.model.parts[0].ky, -0.3);
  EXPECT_EQ(toJson(back), text);
  file.model.parts[0].kx = 1.5;
  EXPECT_FALSE(fromJson(toJson(file), back, &why));
  EXPECT_NE(why.find("taper"), std::string::npos) << why;
}

TEST(ModelIo, AModelHasAThousandPartsAtMost) {
  ModelFile file, back;
  std::string why;
  file.model.parts.resize(1000);
  EXPECT_TRUE(fromJson(toJson(file, -1), back, &why)) << why;
  file.model.parts.resize(1001);
  EXPECT_FALSE(fromJson(toJson(file, -1), back, &why));
  EXPECT_NE(why.find("1001 superquadrics"), std::string::npos) << why;
  EXPECT_TRUE(back.model.empty());
}

TEST(ModelIo, RefusesWhatIsNoModelAndSaysWhy) {
  const std::string good = toJson(sampleFile());
  const auto refuses = [](std::string text,
                          const std::string& from,
                          const std::string& to,
                          const std::string& reason) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    ModelFile file;
    file.frame = "old";
    std::string why;
    EXPECT_FALSE(fromJson(text, file, &why));
    EXPECT_NE(why.find(reason), std::string::npos) << why;
    EXPECT_TRUE(file.frame.empty() && file.model.empty());
  };
  refuses(good, "pcl_sq/model", "other", "not a pcl_sq/model");
  refuses(good, "\"version\": 1", "\"version\": 4", "version 4");
  refuses(good, "\"unit\": \"m\"", "\"unit\": \"mm\"", "unit");
  refuses(good, "\"semi_axes\": [", "\"semi_axes\": [0.1, ", "numbers");
  refuses(good, "\"semi_axes\"", "\"axes\"", "missing");
  refuses(good,
          "\"rotation\": [",
          "\"rotation\": [[2,0,0],[0,1,0],[0,0,1]], \"old\": [",
          "orthonormal");
  refuses(good, "\"epsilon\": [", "\"epsilon\": [3.0, 1.0], \"old\": [", "exponent");
  refuses(
      good, "\"translation\": [", "\"translation\": [1e999, 0, 0], \"old\": [", "JSON");
  refuses(good, "\"superquadrics\": [", "\"superquadrics\": 5, \"old\": [", "list");
  refuses(good, "{", "", "JSON");
}
