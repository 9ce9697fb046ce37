// SPDX-License-Identifier: BSD-3-Clause
// PCL writes PLY into files only, and does not see that a disk is full.
#include "files/cloud_bytes.h"

#include "command_line/app.h"
#include "files/pcd_codec.h"

#ifdef PCL_SQ_PLUG_INS
#include "util/plug_in.h"
#endif

namespace pcl_sq::app {

namespace {

/** \brief The bytes of a number; every machine that PCL runs on has the lowest first.
 */
template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

} // namespace

const PcdCodec& pcdCodec() {
#ifdef PCL_SQ_PLUG_INS
  std::string why;
  auto* codec =
      detail::functionOf<const PcdCodec*()>("pcl_sq_pcd.so", "pcl_sq_pcd_codec", &why);
  if (codec == nullptr)
    throw Failure(why + ".");
  return *codec();
#else
  return *pcl_sq_pcd_codec();
#endif
}

std::string pcdBytes(const pcl::PCLPointCloud2& cloud,
                     const Eigen::Vector4f& origin,
                     const Eigen::Quaternionf& orientation) {
  std::string bytes = pcdCodec().pack(cloud, origin, orientation);
  if (bytes.empty())
    throw Failure("the cloud is too large for a PCD file; crop or thin it first.");
  return bytes;
}

std::string plyBytes(const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " +
      std::to_string(cloud.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nelement camera 1\n";
  for (const char* name : {"view_px",
                           "view_py",
                           "view_pz",
                           "x_axisx",
                           "x_axisy",
                           "x_axisz",
                           "y_axisx",
                           "y_axisy",
                           "y_axisz",
                           "z_axisx",
                           "z_axisy",
                           "z_axisz",
                           "focal",
                           "scalex",
                           "scaley",
                           "centerx",
                           "centery"})
    bytes += std::string("property float ") + name + "\n";
  bytes += "property int viewportx\nproperty int viewporty\nproperty float k1\n"
           "property float k2\nend_header\n";
  for (const auto& p : cloud) {
    for (const float coordinate : {p.x, p.y, p.z})
      append(bytes, coordinate);
    for (const std::uint8_t channel : {p.r, p.g, p.b})
      append(bytes, channel);
  }
  for (int i = 0; i < 3; ++i)
    append(bytes, cloud.sensor_origin_[i]);
  const Eigen::Matrix3f axes = cloud.sensor_orientation_.toRotationMatrix();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      append(bytes, axes(row, column));
  constexpr int LENS = 5; // focal length, scales and centre: PCL has none either
  for (int i = 0; i < LENS; ++i)
    append(bytes, 0.0f);
  append(bytes, static_cast<std::int32_t>(cloud.width));
  append(bytes, static_cast<std::int32_t>(cloud.height));
  append(bytes, 0.0f);
  append(bytes, 0.0f);
  return bytes;
}

} // namespace pcl_sq::app
