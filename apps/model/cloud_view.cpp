// SPDX-License-Identifier: BSD-3-Clause
// What a cloud itself tells of its camera.
#include "files/cloud_io.h"

#include "pcl_sq/object_view.h"

namespace pcl_sq::app {

CloudPoints coordinatesOf(const LoadedCloud& input) {
  using Point = pcl::PointXYZRGBA;
  const auto& points = input.cloud->points;
  return Eigen::Map<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>>(
      points.empty() ? nullptr : points.front().data,
      3,
      static_cast<Eigen::Index>(points.size()),
      Eigen::OuterStride<>(sizeof(Point) / sizeof(float)));
}

std::optional<Eigen::Vector3d> viewpointOf(const LoadedCloud& input) {
  const Eigen::Vector3d origin = input.cloud->sensor_origin_.head<3>().cast<double>();
  std::optional<Eigen::Vector3d> told;
  if (origin.norm() > 0.0 && origin.allFinite())
    told = origin;
  PinholeCamera camera;
  if (input.cloud->isOrganized() && findCamera(coordinatesOf(input),
                                               static_cast<int>(input.cloud->width),
                                               static_cast<int>(input.cloud->height),
                                               told,
                                               camera))
    return camera.center;
  return told;
}

} // namespace pcl_sq::app
