// SPDX-License-Identifier: BSD-3-Clause
// Which points a region keeps, and that PCL's own box keeps the same.
#include "pcl_sq/roi_crop.h"

#include "clouds.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

TEST(RoiCrop, PassesExactlyWhatTheRegionContains) {
  // one ulp of a float decides: 0.1 is no float
  const float above = std::nextafter(static_cast<float>(0.1), 1.0f);
  const float at = static_cast<float>(0.1), below = std::nextafter(at, 0.0f);
  Cloud::Ptr cloud(new Cloud);
  for (const float x : {below, at, above})
    cloud->push_back({x, 0.0f, 0.0f});
  for (const RoiBox& region : {RoiBox{{0.1, -1, -1}, {1, 1, 1}},
                               RoiBox{{-1, -1, -1}, {0.1, 1, 1}},
                               RoiBox{{-1, -1, 0}, {1, 1, 0}}}) {
    RoiCrop<pcl::PointXYZ> crop;
    crop.setRegion(region);
    crop.setInputCloud(cloud);
    pcl::Indices kept, contained;
    crop.filter(kept);
    for (int i = 0; i < 3; ++i)
      if (region.contains(
              (*cloud)[static_cast<std::size_t>(i)].getVector3fMap().cast<double>()))
        contained.push_back(i);
    EXPECT_EQ(kept, contained);
  }
}

TEST(RoiCrop, RegionOutsideOfTheCloudGivesNothing) {
  RoiCrop<pcl::PointXYZ> crop;
  crop.setRegion({{5, 5, 5}, {6, 6, 6}});
  crop.setInputCloud(randomCloud(100, 2));
  Cloud output;
  crop.filter(output);
  EXPECT_TRUE(output.empty());
}

TEST(RoiCrop, RefusesARegionThatIsNoneAndKeepsTheOldOne) {
  const Quiet quiet;
  RoiCrop<pcl::PointXYZ> crop;
  crop.setRegion({{0, 0, 0}, {1, 2, 3}});
  crop.setRegion({{1, 0, 0}, {0, 1, 1}});
  crop.setRegion({{0, 0, 0}, {1, std::nan(""), 1}});
  EXPECT_EQ(crop.getRegion().min, Eigen::Vector3d::Zero());
  EXPECT_EQ(crop.getRegion().max, Eigen::Vector3d(1, 2, 3));
}

TEST(RoiCrop, AgreesWithPclCropBoxForAnyPoseOfTheBox) {
  const Cloud::Ptr cloud = randomCloud(2000, 4);
  RoiCrop<pcl::PointXYZ> ours;
  pcl::CropBox<pcl::PointXYZ> theirs;
  Eigen::Affine3f transform = Eigen::Affine3f::Identity();
  transform.rotate(Eigen::AngleAxisf(0.4f, Eigen::Vector3f(1, 2, 3).normalized()));
  transform.translation() = Eigen::Vector3f(0.1f, -0.2f, 0.3f);
  ours.setRegion({{-0.5, -0.6, -0.7}, {0.4, 0.8, 0.9}});
  theirs.setMin(ours.getMin());
  theirs.setMax(ours.getMax());
  for (pcl::CropBox<pcl::PointXYZ>* crop :
       {&theirs, static_cast<decltype(&theirs)>(&ours)}) {
    crop->setInputCloud(cloud);
    crop->setIndices(someIndices(cloud->size()));
    crop->setTranslation({0.2f, 0.1f, -0.1f});
    crop->setRotation({0.3f, -0.5f, 1.1f});
    crop->setTransform(transform);
  }
  pcl::Indices kept, expected;
  ours.filter(kept);
  theirs.filter(expected);
  EXPECT_EQ(kept, expected);
  EXPECT_GT(kept.size(), 20u);
}
