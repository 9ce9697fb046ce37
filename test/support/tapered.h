// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "random_superquadric.h"

namespace pcl_sq::test {

/** \brief Any tapered superquadric of size about one. */
inline Superquadric anyTapered(Random& random) {
  Superquadric s = random.superquadric();
  s.semi_axes = {
      random.uniform(0.6, 1.5), random.uniform(0.6, 1.5), random.uniform(0.6, 1.5)};
  s.epsilon1 = random.uniform(0.4, 1.6);
  s.epsilon2 = random.uniform(0.4, 1.6);
  s.kx = random.uniform(-0.6, 0.6);
  s.ky = random.uniform(-0.6, 0.6);
  return s;
}

/** \brief The same body before tapering. */
inline Superquadric straight(Superquadric s) {
  s.kx = s.ky = 0.0;
  return s;
}

} // namespace pcl_sq::test
