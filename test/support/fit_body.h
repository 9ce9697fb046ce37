// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "random_superquadric.h"

namespace pcl_sq::test {

/** \brief Household shapes whose description is not nearly that of another. */
inline Superquadric object(Random& random) {
  Superquadric s = random.superquadric();
  s.semi_axes = {0.04, 0.06, 0.09};
  s.semi_axes *= random.uniform(0.7, 1.3);
  s.epsilon1 = random.uniform(0.2, 1.2);
  s.epsilon2 = random.uniform(0.2, 1.2);
  return s;
}

/** \brief Points of its surface, uniform in direction. */
inline Eigen::Matrix3Xd surface(Random& random, const Superquadric& s, int count) {
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) = random.surfacePoint(s);
  return points;
}

} // namespace pcl_sq::test
