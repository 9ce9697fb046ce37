// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>
#include <numeric>
#include <random>

namespace pcl_sq::test {

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/** \brief Points uniform in a box with a corner at (x, y, z); header and pose are set,
 * so that a test can see whether they are handed on. */
inline pcl::PointCloud<pcl::PointXYZ>::Ptr randomCloud(std::size_t count,
                                                       unsigned seed,
                                                       float x = -1.0f,
                                                       float y = -1.0f,
                                                       float z = -1.0f,
                                                       float side = 2.0f) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> along(0.0f, side);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (std::size_t i = 0; i < count; ++i) {
    const float px = x + along(engine), py = y + along(engine), pz = z + along(engine);
    cloud->push_back({px, py, pz});
  }
  cloud->header.frame_id = "camera";
  cloud->header.stamp = 1234;
  cloud->sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  cloud->sensor_orientation_ = Eigen::Quaternionf(0.5f, 0.5f, 0.5f, 0.5f);
  return cloud;
}

/** \brief An organized cloud of a camera's points, row by row. */
inline pcl::PointCloud<pcl::PointXYZ>::Ptr
organized(const Eigen::Matrix3Xf& points, int width, int height) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(std::uint32_t(width),
                                                                std::uint32_t(height));
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getVector3fMap() = points.col(Eigen::Index(i));
  cloud->is_dense = false;
  return cloud;
}

/** \brief The indices of all points. */
inline pcl::IndicesPtr allIndices(std::size_t count) {
  auto indices = pcl::make_shared<pcl::Indices>(count);
  std::iota(indices->begin(), indices->end(), 0);
  return indices;
}

/** \brief Every step-th index, backwards: neither 0..n-1 nor sorted. */
inline pcl::IndicesPtr someIndices(std::size_t count, int step = 3) {
  pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = static_cast<int>(count) - 1; i >= 0; i -= step)
    indices->push_back(i);
  return indices;
}

/** \brief Silences PCL's console while a test provokes messages. */
class Quiet {
public:
  Quiet() : level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~Quiet() { pcl::console::setVerbosityLevel(level_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

} // namespace pcl_sq::test
