// SPDX-License-Identifier: BSD-3-Clause
// What a measurement that belongs beside its pixel costs where the surface is slanted.
#include "sensor/depth_patch.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int REACH = DepthPatch::MARGIN; ///< half a window's side [px]
constexpr int STEP = 2;
constexpr std::size_t PIXELS_OF_SLOPE = 12; ///< pixels that give a slope

} // namespace

Eigen::VectorXf lateralNoise(const Observation& o, const DepthPatch& patch) {
  const PinholeCamera& camera = o.out.camera;
  Eigen::VectorXf errors =
      Eigen::VectorXf::Zero(static_cast<Eigen::Index>(o.out.columns.size()));
  for (std::size_t i = 0; i < o.out.columns.size(); ++i) {
    const int column = o.out.columns[i];
    const int x = column % o.width, y = column / o.width;
    const double depth = patch.depth(x, y);
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    patch.forEachOwn(x, y, REACH, STEP, [&](int dx, int dy, double own) {
      const Eigen::Vector3d place(dx, dy, 1.0);
      square.noalias() += place * place.transpose();
      moment += (own - depth) * place;
      ++count;
    });
    if (count < PIXELS_OF_SLOPE)
      continue;
    const Eigen::Vector3d plane = square.ldlt().solve(moment);
    // slope of the surface against the plane across the ray
    const double slope = std::hypot(plane[0] * camera.fx, plane[1] * camera.fy) / depth;
    const double pixel = depth / std::sqrt(camera.fx * camera.fy);
    errors[static_cast<Eigen::Index>(i)] =
        static_cast<float>(pixel * slope / std::sqrt(1.0 + slope * slope));
  }
  return errors;
}

} // namespace pcl_sq::detail
