// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "random_superquadric.h"

namespace pcl_sq::test {

/** \brief Any body with a rim, tapered, of size about one. \param[in] hollow or solid
 */
inline Superquadric anyOpenBody(Random& random, bool hollow) {
  Superquadric s = random.superquadric();
  s.semi_axes = {
      random.uniform(0.6, 1.5), random.uniform(0.6, 1.5), random.uniform(0.6, 1.5)};
  s.epsilon1 = random.uniform(0.2, 1.3);
  s.epsilon2 = random.uniform(0.4, 1.6);
  s.kx = random.uniform(-0.3, 0.4);
  s.ky = random.uniform(-0.3, 0.4);
  s.rim = random.uniform(-0.3, 0.8);
  if (hollow)
    s.wall = random.uniform(0.03, 0.12);
  return s;
}

/** \brief The same as a solid of revolution. */
inline Superquadric rounded(Superquadric s) {
  s.semi_axes.y() = s.semi_axes.x();
  s.epsilon2 = 1.0;
  s.ky = s.kx;
  return s;
}

} // namespace pcl_sq::test
