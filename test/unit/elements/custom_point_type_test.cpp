// SPDX-License-Identifier: BSD-3-Clause
// A user's own point type, without and with PCL_NO_PRECOMPILE.
#define PCL_NO_PRECOMPILE
#include "pcl_sq/adaptive_voxel_grid.h"
#include "pcl_sq/grasp_point_filter.h"
#include "pcl_sq/prism_segmentation.h"
#include "pcl_sq/roi_crop.h"
#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/sac_model_superquadric.h"
#include "pcl_sq/triangle_mesh.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>
#include <pcl/sample_consensus/ransac.h>

struct ThermalPoint {
  PCL_ADD_POINT4D;
  float kelvin;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

POINT_CLOUD_REGISTER_POINT_STRUCT(
    ThermalPoint, (float, x, x)(float, y, y)(float, z, z)(float, kelvin, kelvin))

TEST(CustomPointType, GoesThroughAllElements) {
  pcl::PointCloud<ThermalPoint>::Ptr cloud(new pcl::PointCloud<ThermalPoint>);
  for (int i = 0; i < 4000; ++i) { // a sheet at 1 m and its noise in front
    ThermalPoint p;
    p.x = 0.002f * static_cast<float>(i % 100);
    p.y = 0.005f * static_cast<float>(i / 100);
    p.z = i % 50 == 0 ? 0.5f : 1.0f;
    p.kelvin = static_cast<float>(i);
    cloud->push_back(p);
  }
  pcl_sq::RoiEstimator<ThermalPoint> roi;
  roi.setInputCloud(cloud);
  pcl_sq::RoiBox region;
  pcl::Indices points;
  ASSERT_TRUE(roi.estimate(region, points));
  EXPECT_EQ(points.size(), 3920u);

  pcl_sq::RoiCrop<ThermalPoint> crop;
  crop.setRegion(region);
  crop.setInputCloud(cloud);
  pcl::PointCloud<ThermalPoint>::Ptr object(new pcl::PointCloud<ThermalPoint>);
  crop.filter(*object);
  ASSERT_EQ(object->size(), 3920u);
  EXPECT_EQ(object->front().kelvin, 1.0f) << "fields unknown to PCL go along";

  pcl_sq::AdaptiveVoxelGrid<ThermalPoint> grid;
  grid.setInputCloud(object);
  pcl::PointCloud<ThermalPoint> voxels;
  grid.filter(voxels);
  EXPECT_EQ(voxels.size(), 400u);

  pcl_sq::PrismSegmentation<ThermalPoint> segmentation;
  segmentation.setInputCloud(object);
  segmentation.setVoxelLayout(grid.getVoxelLayout());
  std::vector<pcl::PointIndices> clusters;
  ASSERT_TRUE(segmentation.segment(clusters));
  EXPECT_EQ(clusters.size(), 1u);

  pcl_sq::MultiSuperquadric sphere;
  sphere.parts.resize(1);
  pcl_sq::GraspPointFilter<ThermalPoint> grasp;
  grasp.setModel(sphere);
  grasp.setInputCloud(object);
  grasp.filter(points);
  EXPECT_FALSE(points.empty());
}

TEST(CustomPointType, IsFittedBySampleConsensus) {
  pcl_sq::Superquadric truth;
  truth.semi_axes = {0.03, 0.04, 0.06};
  truth.epsilon1 = 0.4;
  pcl::PointCloud<ThermalPoint>::Ptr cloud(new pcl::PointCloud<ThermalPoint>);
  for (const Eigen::Vector3d& p : pcl_sq::sampleUniform(truth, 600)) {
    ThermalPoint q;
    q.getVector3fMap() = p.cast<float>();
    q.kelvin = 300.0f;
    cloud->push_back(q);
  }
  using Model = pcl_sq::SampleConsensusModelSuperquadric<ThermalPoint>;
  Model::Ptr model(new Model(cloud));
  pcl::RandomSampleConsensus<ThermalPoint> ransac(model, 0.002);
  ransac.setMaxIterations(20);
  ASSERT_TRUE(ransac.computeModel());
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  EXPECT_GT(inliers.size(), 570u);
  Eigen::VectorXf coefficients;
  ransac.getModelCoefficients(coefficients);
  pcl::PointCloud<ThermalPoint> projected;
  model->projectPoints(inliers, coefficients, projected, false);
  ASSERT_EQ(projected.size(), inliers.size());
  EXPECT_EQ(projected.front().kelvin, 300.0f) << "fields unknown to PCL go along";
}
