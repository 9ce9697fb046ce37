// SPDX-License-Identifier: BSD-3-Clause
// Several things, one after the other: RANSAC, take the inliers out, again.
#include "pcl_sq/superquadric_segmentation.h"

#include "clouds.h"
#include "surface_cloud.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>

#include <algorithm>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

Superquadric canAt(double x, double radius, double height) {
  Superquadric s;
  s.center = {x, 0.0, 0.8};
  s.semi_axes = {radius, radius, 0.5 * height};
  s.epsilon1 = 0.2;
  return s;
}

Cloud::Ptr cloudOf(const std::vector<Superquadric>& things,
                   std::size_t points,
                   unsigned int seed = 1) {
  auto cloud = pcl::make_shared<Cloud>();
  for (std::size_t k = 0; k < things.size(); ++k) {
    const Eigen::Matrix3Xd samples =
        surfaceCloud(things[k], points, unsigned(k) + seed, 0.0005);
    for (Eigen::Index i = 0; i < samples.cols(); ++i)
      cloud->push_back(
          Point(float(samples(0, i)), float(samples(1, i)), float(samples(2, i))));
  }
  return cloud;
}

pcl::IndicesPtr without(const pcl::Indices& all, pcl::Indices taken) {
  std::sort(taken.begin(), taken.end());
  auto rest = pcl::make_shared<pcl::Indices>();
  std::set_difference(
      all.begin(), all.end(), taken.begin(), taken.end(), std::back_inserter(*rest));
  return rest;
}

/** \brief The thing whose place is nearest; fails if size or place are wrong. */
std::size_t expectOneOf(const std::vector<Superquadric>& things,
                        const Superquadric& found) {
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < things.size(); ++k)
    if ((things[k].center - found.center).norm() <
        (things[nearest].center - found.center).norm())
      nearest = k;
  EXPECT_LT((things[nearest].center - found.center).norm(), 0.004);
  EXPECT_NEAR(found.volume() / things[nearest].volume(), 1.0, 0.1);
  return nearest;
}

SuperquadricSegmentation<Point> segmentationOf(const Cloud::Ptr& cloud) {
  SuperquadricSegmentation<Point> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setDistanceThreshold(0.003);
  segmentation.setMaxIterations(150);
  segmentation.setRadiusLimits(0.01, 0.15);
  return segmentation;
}

/** \brief Takes the scene apart; each thing must be found once. */
void expectEachThingOnce(const std::vector<Superquadric>& things,
                         SuperquadricSegmentation<Point> segmentation,
                         const Cloud& cloud) {
  pcl::IndicesPtr rest = allIndices(cloud.size());
  std::vector<int> found(things.size(), 0);
  for (std::size_t k = 0; k < things.size(); ++k) {
    segmentation.setIndices(rest);
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    segmentation.segment(inliers, coefficients);
    ASSERT_EQ(coefficients.values.size(), 11u) << "after " << k << " things";
    ++found[expectOneOf(things, Superquadric::fromCoefficients(coefficients.values))];
    rest = without(*rest, inliers.indices);
  }
  for (const int times : found)
    EXPECT_EQ(times, 1);
}

std::string errorsOf(SuperquadricSegmentation<Point>& segmentation) {
  pcl::PointIndices inliers;
  inliers.indices = {1, 2, 3};
  pcl::ModelCoefficients coefficients;
  coefficients.values = {1.0f};
  testing::internal::CaptureStderr();
  segmentation.segment(inliers, coefficients);
  EXPECT_TRUE(inliers.indices.empty());
  EXPECT_TRUE(coefficients.values.empty());
  return testing::internal::GetCapturedStderr();
}

} // namespace

TEST(SuperquadricSegmentation, TwoThingsFarApartAreFoundOneAfterTheOther) {
  const std::vector<Superquadric> things = {canAt(-0.2, 0.033, 0.12),
                                            canAt(0.2, 0.05, 0.08)};
  const auto cloud = cloudOf(things, 1500);
  expectEachThingOnce(things, segmentationOf(cloud), *cloud);
}

TEST(SuperquadricSegmentation, ThreeThingsSideBySideAreFoundOneAfterTheOther) {
  const std::vector<Superquadric> things = {
      canAt(-0.12, 0.033, 0.12), canAt(0.0, 0.04, 0.1), canAt(0.13, 0.035, 0.11)};
  // a box through two of them has more points near to it than any of the three
  for (const unsigned int seed : {1, 4, 7, 10, 13, 16}) {
    const auto cloud = cloudOf(things, 1000, seed);
    expectEachThingOnce(things, segmentationOf(cloud), *cloud);
  }
}

TEST(SuperquadricSegmentation, SamplesMaxDistChoosesTheSizeOfAPlaceWithoutASearch) {
  const std::vector<Superquadric> things = {canAt(-0.2, 0.033, 0.12),
                                            canAt(0.2, 0.05, 0.08)};
  const auto cloud = cloudOf(things, 1500);
  auto segmentation = segmentationOf(cloud);
  segmentation.setRadiusLimits(0.0, 1.0);
  segmentation.setSamplesMaxDist(0.15, nullptr);
  expectEachThingOnce(things, segmentation, *cloud);
}

TEST(SuperquadricSegmentation, RadiusLimitsBoundTheSemiAxes) {
  const auto cloud = cloudOf({canAt(-0.2, 0.033, 0.12), canAt(0.2, 0.06, 0.16)}, 1000);
  auto segmentation = segmentationOf(cloud);
  segmentation.setRadiusLimits(0.01, 0.065);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  segmentation.segment(inliers, coefficients);
  ASSERT_EQ(coefficients.values.size(), 11u);
  EXPECT_LT(Superquadric::fromCoefficients(coefficients.values).semi_axes.maxCoeff(),
            0.065);
}

TEST(SuperquadricSegmentation, AxisAndAngleBoundTheDirection) {
  const auto cloud = cloudOf({canAt(0.0, 0.03, 0.16)}, 1000);
  auto segmentation = segmentationOf(cloud);
  segmentation.setAxis(Eigen::Vector3f::UnitZ());
  segmentation.setEpsAngle(0.05);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  segmentation.segment(inliers, coefficients);
  ASSERT_EQ(coefficients.values.size(), 11u);
  EXPECT_GT(
      std::abs(Superquadric::fromCoefficients(coefficients.values).rotation(2, 2)),
      std::cos(0.05));
  segmentation.setAxis(Eigen::Vector3f(1, 1, 1));
  EXPECT_FALSE(errorsOf(segmentation).empty()) << "nothing lies along this axis";
}

TEST(SuperquadricSegmentation, OptimisedCoefficientsAreNearerToTheTruth) {
  const std::vector<Superquadric> things = {canAt(0.0, 0.04, 0.1)};
  const auto cloud = cloudOf(things, 1000);
  double volume_error[2];
  for (const bool optimise : {false, true}) {
    auto segmentation = segmentationOf(cloud);
    segmentation.setMaxIterations(5);
    segmentation.setMethodType(pcl::SAC_MSAC);
    segmentation.setOptimizeCoefficients(optimise);
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    segmentation.segment(inliers, coefficients);
    ASSERT_EQ(coefficients.values.size(), 11u);
    volume_error[optimise] =
        std::abs(Superquadric::fromCoefficients(coefficients.values).volume() /
                     things[0].volume() -
                 1.0);
  }
  EXPECT_LT(volume_error[true], volume_error[false]);
  EXPECT_LT(volume_error[true], 0.01);
}

TEST(SuperquadricSegmentation, WhatCannotWorkIsRefusedWithASentence) {
  SuperquadricSegmentation<Point> segmentation;
  EXPECT_NE(errorsOf(segmentation).find("setInputCloud"), std::string::npos);
  segmentation.setInputCloud(cloudOf({canAt(0.0, 0.04, 0.1)}, 100));
  EXPECT_NE(errorsOf(segmentation).find("setDistanceThreshold"), std::string::npos);
  segmentation.setDistanceThreshold(0.003);
  segmentation.setMethodType(pcl::SAC_RRANSAC);
  EXPECT_NE(errorsOf(segmentation).find("SAC_MSAC"), std::string::npos);
}

TEST(SuperquadricSegmentation, TooFewPointsInAPlaceEndSoonAndGiveNothing) {
  const auto cloud = cloudOf({canAt(0.0, 0.04, 0.1)}, 200);
  auto segmentation = segmentationOf(cloud);
  segmentation.setSamplesMaxDist(1e-4, nullptr);
  EXPECT_FALSE(errorsOf(segmentation).empty());
}

TEST(SampleConsensusModel, OfCloudsWithNanFindsWhatIsThere) {
  const std::vector<Superquadric> things = {canAt(-0.2, 0.033, 0.12),
                                            canAt(0.2, 0.05, 0.08)};
  const auto cloud = cloudOf(things, 1000);
  const float nan = std::nanf("");
  for (int i = 0; i < 1000; ++i)
    cloud->push_back(Point(nan, nan, nan));
  const auto model = pcl::make_shared<SampleConsensusModelSuperquadric<Point>>(cloud);
  model->setRadiusLimits(0.01, 0.15);
  pcl::RandomSampleConsensus<Point> ransac(model, 0.003);
  ransac.setMaxIterations(100);
  ASSERT_TRUE(ransac.computeModel());
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  Eigen::VectorXf coarse, fine;
  ransac.getModelCoefficients(coarse);
  model->optimizeModelCoefficients(inliers, coarse, fine);
  expectOneOf(things, Superquadric::fromCoefficients(fine));
}
