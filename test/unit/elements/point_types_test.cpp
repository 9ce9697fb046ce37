// SPDX-License-Identifier: BSD-3-Clause
// PCL's own point types, labelled ones among them, compile and link as they are.
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/sac_model_superquadric.h"
#include "pcl_sq/tabletop_segmentation.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

using namespace pcl_sq;

template <typename PointT>
struct PointTypes : testing::Test {};

using Types = testing::Types<pcl::PointXYZ,
                             pcl::PointXYZI,
                             pcl::PointXYZL,
                             pcl::PointXYZRGB,
                             pcl::PointXYZRGBA,
                             pcl::PointXYZRGBL,
                             pcl::PointNormal,
                             pcl::PointXYZINormal,
                             pcl::PointXYZLNormal,
                             pcl::PointXYZRGBNormal,
                             pcl::PointWithViewpoint,
                             pcl::PointSurfel>;
TYPED_TEST_SUITE(PointTypes, Types);

TYPED_TEST(PointTypes, GiveTheSameModelWhateverElseAPointHolds) {
  test::Random random(5);
  Superquadric box;
  box.center = {0.05, 0.02, 0.8};
  box.semi_axes = {0.03, 0.04, 0.06};
  box.epsilon1 = box.epsilon2 = 0.2;
  auto cloud = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  auto plain = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (int i = 0; i < 600; ++i) {
    const Eigen::Vector3f p = random.surfacePoint(box).template cast<float>();
    TypeParam point;
    point.getVector3fMap() = p;
    cloud->push_back(point);
    plain->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  EstimationOptions options;
  options.decomposition = Decomposition::NONE;
  ObjectSurfaceEstimation<TypeParam> estimation;
  estimation.setOptions(options);
  estimation.setInputCloud(cloud);
  ObjectSurfaceEstimation<pcl::PointXYZ> of_plain;
  of_plain.setOptions(options);
  of_plain.setInputCloud(plain);
  MultiSuperquadric model, expected;
  ASSERT_TRUE(estimation.estimate(model));
  ASSERT_TRUE(of_plain.estimate(expected));
  ASSERT_EQ(model.size(), 1u);
  EXPECT_EQ(model.parts[0].toCoefficients(), expected.parts[0].toCoefficients());

  SampleConsensusModelSuperquadric<TypeParam> consensus(cloud);
  EXPECT_GT(consensus.countWithinDistance(
                model.parts[0].toCoefficients().template cast<float>(), 0.001),
            500u);
  TabletopSegmentation<TypeParam> tabletop;
  tabletop.setInputCloud(cloud);
  pcl::Indices object;
  (void)tabletop.segment(object); // links; there may be no table
}
