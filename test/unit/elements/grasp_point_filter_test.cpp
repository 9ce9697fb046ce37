// SPDX-License-Identifier: BSD-3-Clause
// Which points are on the surface of a model, and what is told of each.
#include "pcl_sq/grasp_point_filter.h"

#include "clouds.h"
#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

namespace {

/** \brief Two balls side by side with a common piece. */
MultiSuperquadric twoBalls() {
  MultiSuperquadric model;
  model.parts.resize(2);
  for (Superquadric& s : model.parts)
    s.semi_axes.setConstant(0.05);
  model.parts[1].center.x() = 0.08;
  return model;
}

pcl::PointXYZ toPcl(const Eigen::Vector3d& p) {
  return {float(p.x()), float(p.y()), float(p.z())};
}

/** \brief Points of the balls with noise of sigma along the normal. */
Cloud::Ptr noisyCloud(Random& random, double sigma, int count) {
  const MultiSuperquadric model = twoBalls();
  auto cloud = pcl::make_shared<Cloud>();
  while (int(cloud->size()) < count) {
    const Superquadric& s = model.parts[cloud->size() % 2];
    const Eigen::Vector3d p = random.surfacePoint(s);
    if (model.gauge(p) < 0.999)
      continue; // inside of the other ball
    cloud->push_back(toPcl(p + random.normal(sigma) * s.normal(p)));
  }
  return cloud;
}

} // namespace

TEST(GraspPointFilter, SigmaIsTheNoiseOfTheCloudWhateverTheOutliers) {
  Random random(501);
  for (const double sigma : {0.0005, 0.002}) {
    auto cloud = noisyCloud(random, sigma, 4000);
    for (int i = 0; i < 400; ++i)
      cloud->push_back(toPcl(0.5 * random.direction()));
    GraspPointFilter<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setModel(twoBalls());
    filter.setSigmaThreshold(2.0);
    EXPECT_EQ(filter.getMetric(), SurfaceMetric::SIGMA);
    pcl::Indices kept;
    filter.filter(kept);
    EXPECT_NEAR(filter.getSigma(), sigma, 0.2 * sigma);
    // 95 % of a normal distribution lie within two sigma
    EXPECT_NEAR(double(kept.size()) / 4000.0, 0.95, 0.04);
    for (const auto i : kept)
      EXPECT_LT(i, 4000);
  }
}

TEST(GraspPointFilter, DescriptionsHavePartNormalAndResidual) {
  Random random(502);
  const MultiSuperquadric model = twoBalls();
  auto cloud = noisyCloud(random, 0.001, 200);
  cloud->sensor_origin_ << 1, 2, 3, 0;
  cloud->header.frame_id = "camera";
  GraspPointFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setModel(model);
  pcl::Indices every_third;
  for (int i = 0; i < 200; i += 3)
    every_third.push_back(i);
  pcl::PointCloud<PointGrasp> points;
  filter.describe(every_third, points);
  ASSERT_EQ(points.size(), every_third.size());
  EXPECT_EQ(points.header.frame_id, "camera");
  EXPECT_EQ(points.sensor_origin_, cloud->sensor_origin_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointGrasp& g = points[i];
    const auto& p = (*cloud)[std::size_t(every_third[i])];
    EXPECT_EQ(g.getVector3fMap(), p.getVector3fMap());
    ASSERT_LT(g.part, 2u);
    const Superquadric& ball = model.parts[g.part];
    const Eigen::Vector3d out = g.getVector3fMap().cast<double>() - ball.center;
    EXPECT_NEAR(g.residual, out.norm() - 0.05, 1e-6); // exact for a ball
    EXPECT_LT((g.getNormalVector3fMap().cast<double>() - out.normalized()).norm(),
              1e-5);
    EXPECT_LE(
        out.norm(),
        (g.getVector3fMap().cast<double>() - model.parts[1 - g.part].center).norm() +
            1e-9);
  }
}

TEST(GraspPointFilter, NegativeSigmaIsRefusedAndAnEmptyModelDescribesNothing) {
  GraspPointFilter<pcl::PointXYZ> filter;
  filter.setSigmaThreshold(-1.0);
  EXPECT_EQ(filter.getSigmaThreshold(), 2.0);
  EXPECT_EQ(filter.getMetric(), SurfaceMetric::GAUGE);
  auto cloud = pcl::make_shared<Cloud>();
  cloud->push_back({0, 0, 0});
  filter.setInputCloud(cloud);
  pcl::PointCloud<PointGrasp> points;
  filter.describe({0}, points);
  EXPECT_TRUE(points.empty());
  EXPECT_EQ(surfaceNoise({}, Eigen::Matrix3Xd::Zero(3, 5)), 0.0);
}

TEST(GraspPointFilter, DistancesAreMetric) {
  MultiSuperquadric sphere;
  sphere.parts.resize(1);
  sphere.parts[0].semi_axes.setConstant(0.05);
  Cloud::Ptr cloud(new Cloud);
  for (const float r : {0.0f, 0.0445f, 0.0455f, 0.05f, 0.0545f, 0.0555f, 1e30f})
    cloud->push_back({0.0f, r, 0.0f});
  GraspPointFilter<pcl::PointXYZ> filter;
  filter.setModel(sphere);
  filter.setInputCloud(cloud);
  pcl::Indices kept;
  filter.setDistanceThreshold(0.005);
  EXPECT_EQ(filter.getMetric(), SurfaceMetric::DISTANCE);
  filter.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{2, 3, 4}));
  filter.setGaugeTolerance(0.05); // 2.5 mm of this sphere
  filter.filter(kept);
  EXPECT_EQ(kept, (pcl::Indices{3}));
}

TEST(GraspPointFilter, SurfacesInsideOfAnotherPartDoNotCount) {
  MultiSuperquadric pair;
  pair.parts.resize(2);
  pair.parts[1].center.x() = 0.5;
  Cloud::Ptr cloud(new Cloud);
  cloud->push_back({1.0f, 0, 0});  // on the first, inside of the second
  cloud->push_back({-1.0f, 0, 0}); // on the first alone
  for (const bool metric : {false, true}) {
    GraspPointFilter<pcl::PointXYZ> filter;
    filter.setModel(pair);
    if (metric)
      filter.setDistanceThreshold(0.05);
    filter.setInputCloud(cloud);
    pcl::Indices kept;
    filter.filter(kept);
    EXPECT_EQ(kept, pcl::Indices{1});
  }
}

TEST(GraspPointFilter, WithoutAModelNoPointIsOnASurface) {
  const Quiet quiet;
  GraspPointFilter<pcl::PointXYZ> filter(true);
  filter.setInputCloud(randomCloud(10, 3));
  Cloud output;
  filter.filter(output);
  EXPECT_TRUE(output.empty());
  EXPECT_EQ(filter.getRemovedIndices()->size(), 10u);
}

TEST(GraspPointFilter, RefusesBadSettingsAndKeepsTheOldOnes) {
  const Quiet quiet;
  GraspPointFilter<pcl::PointXYZ> filter;
  EXPECT_EQ(filter.getGaugeTolerance(), 0.05);
  for (const double bad : {-0.1, std::nan(""), HUGE_VAL}) {
    filter.setGaugeTolerance(bad);
    filter.setDistanceThreshold(bad);
  }
  EXPECT_EQ(filter.getGaugeTolerance(), 0.05);
  EXPECT_EQ(filter.getDistanceThreshold(), 0.005);
  EXPECT_EQ(filter.getMetric(), SurfaceMetric::GAUGE);
  MultiSuperquadric model;
  model.parts.resize(2);
  filter.setModel(model);
  model.parts[1].semi_axes.x() = -1.0;
  model.parts.resize(3);
  filter.setModel(model);
  EXPECT_EQ(filter.getModel().size(), 2u);
}
