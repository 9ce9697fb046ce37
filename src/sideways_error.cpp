// SPDX-License-Identifier: BSD-3-Clause
// What a measurement that belongs beside its pixel costs where the surface is slanted.
#include "observe_parts.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int REACH = 7; ///< half a window's side [px]
constexpr int STEP = 2;
constexpr std::size_t FEWEST = 12; ///< pixels that give a slope

} // namespace

Eigen::VectorXf sidewaysErrors(const Observation& o) {
  const PinholeCamera& camera = o.out.camera;
  Eigen::VectorXf errors =
      Eigen::VectorXf::Zero(static_cast<Eigen::Index>(o.out.columns.size()));
  for (std::size_t i = 0; i < o.out.columns.size(); ++i) {
    const int column = o.out.columns[i];
    const int x = column % o.width, y = column / o.width;
    const double depth = camera.depthOf(o.at(column));
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (int dy = -REACH; dy <= REACH; dy += STEP)
      for (int dx = -REACH; dx <= REACH; dx += STEP) {
        const int c = (y + dy) * o.width + x + dx;
        if (!o.out.pixels(x + dx, y + dy) || !o.finite(c))
          continue;
        const Eigen::Vector3d place(dx, dy, 1.0);
        square.noalias() += place * place.transpose();
        moment += (camera.depthOf(o.at(c)) - depth) * place;
        ++count;
      }
    if (count < FEWEST)
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
