// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/roi_estimator.h"

#include "clouds.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Estimator = RoiEstimator<pcl::PointXYZ>;

namespace {

constexpr int WIDTH = 160, HEIGHT = 120;
constexpr double FOCAL = 200.0, CX = 81.3, CY = 58.9;
constexpr CellRect OBJECT{50, 30, 41, 61}; // the pixels of the box's front

/** A camera before a box, its front 1 m away and slanted to 1.08 m, and a wall at 2 m.
 */
Cloud::Ptr scene() {
  Cloud::Ptr cloud(new Cloud(WIDTH, HEIGHT));
  for (int v = 0; v < HEIGHT; ++v)
    for (int u = 0; u < WIDTH; ++u) {
      double z = OBJECT.contains(u, v) ? 1.0 + 0.002 * (u - OBJECT.x) : 2.0;
      if ((u + v) % 17 == 0)
        z = std::nan("");
      cloud->at(u, v) = {static_cast<float>((u - CX) / FOCAL * z),
                         static_cast<float>((v - CY) / FOCAL * z),
                         static_cast<float>(z)};
    }
  cloud->is_dense = false;
  return cloud;
}

bool isOfObject(int index) {
  return OBJECT.contains(index % WIDTH, index / WIDTH);
}

class RoiEstimatorTest : public testing::Test {
protected:
  RoiEstimatorTest() : cloud(scene()) {
    estimator.setInputCloud(cloud);
    estimator.setRect(
        {OBJECT.x - 6, OBJECT.y - 6, OBJECT.width + 12, OBJECT.height + 12});
  }
  Cloud::Ptr cloud;
  Estimator estimator;
  RoiBox region;
  pcl::Indices points;
};

} // namespace

TEST_F(RoiEstimatorTest, FindsTheObjectOfTheRectangleAndNotTheWallBehind) {
  ASSERT_TRUE(estimator.estimate(region, points));
  std::size_t expected = 0;
  for (int i = 0; i < WIDTH * HEIGHT; ++i)
    expected +=
        isOfObject(i) && std::isfinite(cloud->at(static_cast<std::size_t>(i)).z);
  EXPECT_EQ(points.size(), expected);
  for (const int i : points)
    EXPECT_TRUE(isOfObject(i));
  EXPECT_NEAR(region.min.z(), 1.0, 0.012);
  EXPECT_NEAR(region.max.z(), 1.08, 0.012);
}

TEST_F(RoiEstimatorTest, RegionHoldsAllPointsOfTheFrustum) {
  ASSERT_TRUE(estimator.estimate(region, points));
  for (const int i : points)
    EXPECT_TRUE(region.contains(
        cloud->at(static_cast<std::size_t>(i)).getVector3fMap().cast<double>()));
}

TEST_F(RoiEstimatorTest, SidesAtTheMedianDepthAreTheRectangleBackProjected) {
  estimator.setExtent(RoiExtent::MEDIAN_DEPTH);
  ASSERT_TRUE(estimator.estimate(region, points));
  const double z = estimator.getHistogram().median_depth;
  EXPECT_NEAR(z, 1.04, 0.005);
  const CellRect& rect = estimator.getRect();
  EXPECT_NEAR(region.min.x(), (rect.x - 0.5 - CX) / FOCAL * z, 1e-5);
  EXPECT_NEAR(region.max.x(), (rect.x + rect.width - 0.5 - CX) / FOCAL * z, 1e-5);
  EXPECT_NEAR(region.min.y(), (rect.y - 0.5 - CY) / FOCAL * z, 1e-5);
  EXPECT_NEAR(region.max.y(), (rect.y + rect.height - 0.5 - CY) / FOCAL * z, 1e-5);
}

TEST_F(RoiEstimatorTest, BinsOfDisparityGiveTheSameObject) {
  DepthHistogramOptions options;
  options.disparity_scale = FOCAL * 0.12; // 24 px at 1 m
  estimator.setHistogramOptions(options);
  ASSERT_TRUE(estimator.estimate(region, points));
  EXPECT_EQ(estimator.getHistogram().first_bin, 22);
  EXPECT_NEAR(region.max.z(), 24.0 / 22.0, 1e-9);
  for (const int i : points)
    EXPECT_TRUE(isOfObject(i));
}

TEST_F(RoiEstimatorTest, IndicesAreAMask) {
  pcl::IndicesPtr mask(new pcl::Indices);
  for (int i = WIDTH * HEIGHT - 1; i >= 0; --i)
    if (isOfObject(i) && i % 2 == 0)
      mask->push_back(i);
  estimator.setIndices(mask);
  ASSERT_TRUE(estimator.estimate(region, points));
  EXPECT_TRUE(std::is_sorted(points.rbegin(), points.rend())) << "order of the indices";
  for (const int i : points)
    EXPECT_EQ(i % 2, 0);
  estimator.setRect({});
  pcl::Indices without_rect;
  ASSERT_TRUE(estimator.estimate(region, without_rect));
  EXPECT_EQ(without_rect, points);
}

TEST_F(RoiEstimatorTest, TheRectangleMayReachOverTheImagesBorder) {
  estimator.setRect({-1000, -1000, 5000, 5000});
  ASSERT_TRUE(estimator.estimate(region, points));
  EXPECT_GT(points.size(), 10000u) << "the wall";
}

TEST_F(RoiEstimatorTest, UnorganizedCloudsWorkWithoutARectangle) {
  cloud->width = WIDTH * HEIGHT;
  cloud->height = 1;
  pcl::IndicesPtr mask(new pcl::Indices);
  for (int i = 0; i < WIDTH * HEIGHT; ++i)
    if (isOfObject(i))
      mask->push_back(i);
  estimator.setIndices(mask);
  {
    const Quiet quiet;
    EXPECT_FALSE(estimator.estimate(region, points));
  }
  estimator.setRect({});
  EXPECT_TRUE(estimator.estimate(region, points));
}

TEST_F(RoiEstimatorTest, FailsWithNothingLeftBehind) {
  const Quiet quiet;
  const auto isRefused = [this] {
    points = {1, 2, 3};
    region.max.setOnes();
    return !estimator.estimate(region, points) && points.empty() &&
           region.sizes().isZero();
  };
  const int largest = std::numeric_limits<int>::max();
  for (const CellRect& off : {CellRect{WIDTH, 0, 10, 10},
                              CellRect{-50, 5, 50, 50},
                              CellRect{-largest - 1, -largest - 1, 10, 10},
                              CellRect{largest, largest, largest, largest}}) {
    estimator.setRect(off);
    EXPECT_TRUE(isRefused());
  }
  estimator.setRect(OBJECT);
  for (auto& p : *cloud)
    p.z = NOT_A_NUMBER;
  EXPECT_TRUE(isRefused());
  for (auto& p : *cloud)
    p = {0.0f, 0.0f, -1.0f};
  EXPECT_TRUE(isRefused()) << "behind the camera";
  Cloud::Ptr empty(new Cloud);
  estimator.setInputCloud(empty);
  estimator.setRect({});
  EXPECT_TRUE(isRefused());
  Estimator unset;
  EXPECT_FALSE(unset.estimate(region, points));
}

TEST_F(RoiEstimatorTest, OutliersAtTheEndOfTheFloatRangeDoNotMatter) {
  for (int u = 60; u < 80; ++u) {
    cloud->at(u, 40) = {1e30f, 1e30f, 1e30f};
    cloud->at(u, 41) = {1e-30f, 1e-30f, 1e-30f};
  }
  ASSERT_TRUE(estimator.estimate(region, points));
  EXPECT_LT(region.sizes().maxCoeff(), 0.4);
}

TEST_F(RoiEstimatorTest, SidesAtTheMedianDepthNeedThePinholesFrame) {
  const Quiet quiet;
  estimator.setExtent(RoiExtent::MEDIAN_DEPTH);
  for (auto& p : *cloud)
    p.x = -p.x; // mirrored
  EXPECT_FALSE(estimator.estimate(region, points));
  EXPECT_TRUE(points.empty());
}

TEST_F(RoiEstimatorTest, RefusesBadOptionsAndKeepsTheOldOnes) {
  const Quiet quiet;
  DepthHistogramOptions options;
  options.max_gap = 3;
  estimator.setHistogramOptions(options);
  options.max_gap = -1;
  estimator.setHistogramOptions(options);
  EXPECT_EQ(estimator.getHistogramOptions().max_gap, 3);
}
