// SPDX-License-Identifier: BSD-3-Clause
// Indices of no point, such as those of the cloud before, and an image whose sides are
// not those of its points: refused by each class, nothing outside of the cloud is read.
#include "pcl_sq/adaptive_voxel_grid.h"
#include "pcl_sq/grasp_point_filter.h"
#include "pcl_sq/prism_segmentation.h"
#include "pcl_sq/roi_crop.h"
#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/scene_estimation.h"
#include "pcl_sq/superquadric_segmentation.h"
#include "pcl_sq/tabletop_segmentation.h"

#include "clouds.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

namespace {

using Point = pcl::PointXYZ;
using PointList = pcl::PointCloud<Point>;

/** \brief Calls f with each kind of wrong indices into a cloud of 100 points. */
template <typename Element, typename Function>
void withWrongIndices(Element& element, const Function& f) {
  const auto cloud = test::randomCloud(100, 1);
  for (const pcl::index_t wrong : {-1, 100, 1 << 30}) {
    SCOPED_TRACE(wrong);
    element.setInputCloud(cloud);
    const auto indices = test::allIndices(100);
    (*indices)[50] = wrong;
    element.setIndices(indices);
    f(element);
  }
  element.setIndices(test::allIndices(100)); // and a smaller cloud than they are for
  element.setInputCloud(test::randomCloud(20, 1));
  f(element);
}

PointList::Ptr imageOfOtherSides() {
  const auto cloud = test::randomCloud(100, 1);
  cloud->width = 640;
  cloud->height = 480;
  return cloud;
}

} // namespace

TEST(StaleIndices, AreRefusedByTheEstimations) {
  MultiSuperquadric model;
  ObjectSurfaceEstimation<Point> estimation;
  withWrongIndices(estimation, [&](auto& e) {
    EXPECT_FALSE(e.estimate(model));
    EXPECT_NE(e.getReport().failure.find("setIndices"), std::string::npos);
  });
  SceneEstimation<Point> scenes;
  Scene scene;
  withWrongIndices(scenes, [&](auto& e) {
    EXPECT_FALSE(e.estimate(scene));
    EXPECT_NE(scene.failure.find("setIndices"), std::string::npos);
  });
}

TEST(StaleIndices, AreRefusedByTheSegmentations) {
  RoiEstimator<Point> regions;
  RoiBox region;
  pcl::Indices points;
  withWrongIndices(regions, [&](auto& e) { EXPECT_FALSE(e.estimate(region, points)); });
  TabletopSegmentation<Point> tabletop;
  withWrongIndices(tabletop, [&](auto& e) {
    EXPECT_FALSE(e.segment(points));
    EXPECT_NE(e.getFailure().find("setIndices"), std::string::npos);
  });
  AdaptiveVoxelGrid<Point> grid;
  PointList centroids;
  grid.setInputCloud(test::randomCloud(100, 1));
  grid.setDivisions({2, 2, 2});
  grid.filter(centroids);
  PrismSegmentation<Point> prisms;
  prisms.setVoxelLayout(grid.getVoxelLayout());
  std::vector<pcl::PointIndices> clusters;
  withWrongIndices(prisms, [&](auto& e) { EXPECT_FALSE(e.segment(clusters)); });
  SuperquadricSegmentation<Point> ransac;
  ransac.setDistanceThreshold(0.01);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  withWrongIndices(ransac, [&](auto& e) {
    e.segment(inliers, coefficients);
    EXPECT_TRUE(inliers.indices.empty());
    EXPECT_FALSE(Superquadric::fromCoefficients(coefficients.values).isValid());
  });
}

TEST(StaleIndices, AreRefusedByTheFilters) {
  PointList output;
  pcl::Indices kept;
  AdaptiveVoxelGrid<Point> grid;
  grid.setDivisions({2, 2, 2});
  withWrongIndices(grid, [&](auto& e) {
    e.filter(output);
    EXPECT_TRUE(output.empty());
  });
  RoiCrop<Point> crop;
  crop.setRegion({{-9.0, -9.0, -9.0}, {9.0, 9.0, 9.0}});
  withWrongIndices(crop, [&](auto& e) {
    e.filter(kept);
    EXPECT_TRUE(kept.empty());
  });
  GraspPointFilter<Point> on_surface;
  MultiSuperquadric model;
  model.parts.resize(1);
  on_surface.setModel(model);
  on_surface.setNegative(true);
  withWrongIndices(on_surface, [&](auto& e) {
    e.filter(kept);
    EXPECT_TRUE(kept.empty());
  });
}

TEST(ImageOfOtherSides, IsRefused) {
  ObjectSurfaceEstimation<Point> estimation;
  estimation.setInputCloud(imageOfOtherSides());
  MultiSuperquadric model;
  EXPECT_FALSE(estimation.estimate(model));
  EXPECT_NE(estimation.getReport().failure.find("width"), std::string::npos);
  SceneEstimation<Point> scenes;
  scenes.setInputCloud(imageOfOtherSides());
  Scene scene;
  EXPECT_FALSE(scenes.estimate(scene));
  EXPECT_NE(scene.failure.find("width"), std::string::npos);
}

TEST(ListOfOtherWidth, IsAListOfItsPoints) {
  const auto cloud = test::randomCloud(300, 1);
  ObjectSurfaceEstimation<Point> estimation;
  MultiSuperquadric model;
  estimation.setInputCloud(cloud);
  const bool found = estimation.estimate(model);
  for (const std::uint32_t width : {0U, 7U, 70000U}) {
    cloud->width = width;
    EXPECT_EQ(estimation.estimate(model), found) << width;
    EXPECT_EQ(estimation.getReport().region_points, 300U) << width;
  }
}

TEST(NumberOfThreads, MayBeAnyNumber) {
  ObjectSurfaceEstimation<Point> estimation;
  MultiSuperquadric one, many;
  estimation.setInputCloud(test::randomCloud(300, 1));
  estimation.setNumberOfThreads(1);
  const bool found = estimation.estimate(one);
  estimation.setNumberOfThreads(static_cast<unsigned int>(-1));
  EXPECT_EQ(estimation.estimate(many), found);
  EXPECT_EQ(one.size(), many.size());
}

TEST(Coefficients, OfNothingAreNoSuperquadric) {
  EXPECT_FALSE(Superquadric::fromCoefficients(std::vector<float>()).isValid());
  EXPECT_FALSE(Superquadric::fromCoefficients(std::vector<float>(10, 1.0F)).isValid());
  EXPECT_FALSE(Superquadric::fromCoefficients(Eigen::VectorXf(0)).isValid());
}

TEST(TooSmallToBeKept, GivesNoModel) {
  const auto cloud = test::randomCloud(300, 1);
  for (Point& point : *cloud)
    point.getVector3fMap() *= 1e-30F;
  ObjectSurfaceEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  MultiSuperquadric model;
  if (!estimation.estimate(model)) {
    EXPECT_TRUE(model.empty());
    return;
  }
  for (const Superquadric& part : model.parts)
    EXPECT_TRUE(part.isValid());
}
