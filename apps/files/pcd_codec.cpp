// SPDX-License-Identifier: BSD-3-Clause
#include "files/pcd_codec.h"

#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <sstream>

namespace pcl_sq::app {
namespace {

std::string pack(const pcl::PCLPointCloud2& cloud,
                 const Eigen::Vector4f& origin,
                 const Eigen::Quaternionf& orientation) {
  std::ostringstream out;
  if (pcl::PCDWriter().writeBinaryCompressed(out, cloud, origin, orientation) != 0 ||
      !out)
    return {};
  return out.str();
}

} // namespace
} // namespace pcl_sq::app

const pcl_sq::app::PcdCodec* pcl_sq_pcd_codec() {
  using namespace pcl_sq::app;
  static const PcdCodec CODEC{pack, pcl::lzfDecompress};
  return &CODEC;
}
