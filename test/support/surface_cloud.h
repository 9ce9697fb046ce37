// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"
#include "random_superquadric.h"

namespace pcl_sq::test {

/** \brief Points uniform on the surface with Gaussian noise of \a sigma [m]. */
inline Eigen::Matrix3Xd surfaceCloud(const Superquadric& s,
                                     std::size_t count,
                                     unsigned seed,
                                     double sigma = 0.0) {
  const std::vector<Eigen::Vector3d> samples = sampleUniform(s, count, seed);
  Random random(seed + 1000);
  Eigen::Matrix3Xd points(3, count);
  for (std::size_t i = 0; i < count; ++i)
    points.col(i) =
        samples[i] +
        sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return points;
}

} // namespace pcl_sq::test
