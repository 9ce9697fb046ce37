// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

#include <string>

namespace pcl_sq::app {

/** \brief What PCL's io does, which brings VTK with it. Where libraries are shared this
 * is a plug-in, so that only runs that need it load it. */
struct PcdCodec {
  /** \brief Compressed binary file; empty where the cloud is too large for that. */
  std::string (*pack)(const pcl::PCLPointCloud2& cloud,
                      const Eigen::Vector4f& origin,
                      const Eigen::Quaternionf& orientation);
  /** \brief LZF. \return the number of bytes, 0 of corrupt ones */
  unsigned int (*unpack)(const void* packed,
                         unsigned int packed_bytes,
                         void* data,
                         unsigned int bytes);
};

/** \brief Loads it at the first call. \throw Failure if it cannot be loaded */
const PcdCodec& pcdCodec();

} // namespace pcl_sq::app

/** \brief The one function of the plug-in. */
extern "C" __attribute__((visibility("default"))) const pcl_sq::app::PcdCodec*
pcl_sq_pcd_codec();
