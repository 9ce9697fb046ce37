// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/taper.h"
#include "kernels/kernels.h"
#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <vector>

namespace pcl_sq::test {

/** \brief A superquadric of size one and points within a tenth of its surface. */
struct KernelScene {
  Superquadric shape;
  std::vector<Eigen::Vector3d> points;
  detail::UnitPoints packed;

  KernelScene(Random& random, std::size_t count) {
    shape = random.superquadric();
    shape.center = 0.3 * random.direction();
    shape.semi_axes = {
        random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2)};
    shape.epsilon1 = random.uniform(0.1, 1.9);
    shape.epsilon2 = random.uniform(0.1, 1.9);
    packed.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f p =
          (shape.center +
           random.uniform(0.9, 1.1) * (random.surfacePoint(shape) - shape.center))
              .cast<float>();
      points.push_back(p.cast<double>());
      packed.add(p[0], p[1], p[2]);
    }
  }
};

/** \brief Planes from their seven arrays, in the order of Planes. */
inline kernels::Planes planesOf(const std::vector<std::vector<float>>& a,
                                std::size_t count) {
  return {a[0].data(),
          a[1].data(),
          a[2].data(),
          a[3].data(),
          a[4].data(),
          a[5].data(),
          a[6].data(),
          count};
}

/** \brief A test for each set of instructions that this machine has. */
class EveryIsa : public testing::TestWithParam<kernels::Isa> {
protected:
  const kernels::Kernels* kernels_ = kernels::kernelsFor(GetParam());
  void SetUp() override {
    if (!kernels_)
      GTEST_SKIP() << "this machine lacks the instructions";
  }
};

} // namespace pcl_sq::test
