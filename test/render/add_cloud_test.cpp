// SPDX-License-Identifier: BSD-3-Clause
// PCL's clouds as they are, in their own colours.
#include "pcl_sq/visualization/snapshot_renderer.h"

#include <gtest/gtest.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

using namespace pcl_sq;

namespace {

/** \brief A square of points that fills the picture, \a paint called for each. */
template <typename PointT, typename Paint>
pcl::PointCloud<PointT> square(Paint paint) {
  pcl::PointCloud<PointT> cloud;
  for (int i = 0; i < 100; ++i) {
    PointT p;
    p.x = 0.1f * float(i % 10);
    p.y = 0.1f * float(i / 10);
    p.z = 1.0f;
    paint(p);
    cloud.push_back(p);
  }
  PointT nowhere;
  nowhere.x = nowhere.y = nowhere.z = std::nanf("");
  cloud.push_back(nowhere);
  return cloud;
}

/** \brief Counts pixels that are clearly red. */
int redPixels(const SnapshotImage& image) {
  int red = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    red += image.rgb[i] > 150 && image.rgb[i + 1] < 80 && image.rgb[i + 2] < 80;
  return red;
}

template <typename PointT>
int redOf(const pcl::PointCloud<PointT>& cloud) {
  SnapshotOptions options;
  options.width = options.height = 128;
  options.view = View::FRONT;
  options.axes = options.scale_bar = false;
  options.point_size = 6.0;
  SnapshotRenderer renderer(options);
  renderer.addCloud(cloud);
  return redPixels(renderer.render());
}

} // namespace

TEST(AddCloud, PointsWithColourKeepIt) {
  const auto paint = [](auto& p) {
    p.r = 220;
    p.g = p.b = 10;
  };
  EXPECT_GT(redOf(square<pcl::PointXYZRGB>(paint)), 500);
  EXPECT_GT(redOf(square<pcl::PointXYZRGBA>(paint)), 500);
  EXPECT_GT(redOf(square<pcl::PointXYZRGBNormal>(paint)), 500);
}

TEST(AddCloud, PointsWithoutColourAreNeutral) {
  const auto leave = [](auto&) {};
  EXPECT_EQ(redOf(square<pcl::PointXYZ>(leave)), 0);
  EXPECT_EQ(redOf(square<pcl::PointXYZL>(leave)), 0);
}
