// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/triangle_mesh.h"
#include "pcl_sq/visibility.h"
#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

TEST(Visibility, OfOneConvexBodyIsTheSideThatFacesTheEye) {
  test::Random random(5);
  for (int i = 0; i < 20; ++i) {
    MultiSuperquadric model;
    model.parts.push_back(random.superquadric());
    const Superquadric& s = model.parts[0];
    const double size = s.semi_axes.maxCoeff();
    const Eigen::Vector3d eye =
        s.center + 6.0 * size * Eigen::Vector3d(0.6, -0.64, 0.48);
    int hidden = 0, near = 0;
    for (const Eigen::Vector3d& p : sampleUniform(s, 500, 7)) {
      const double facing = s.normal(p).dot((eye - p).normalized());
      if (std::abs(facing) < 0.05) // the rim belongs to both
        continue;
      const bool h = isHidden(model, p, eye, 1e-6 * size);
      EXPECT_EQ(h, facing < 0.0) << facing;
      (h ? hidden : near)++;
    }
    EXPECT_GT(hidden, 50);
    EXPECT_GT(near, 50);
  }
}

TEST(Visibility, APartHidesWhatIsBehindOrInsideOfIt) {
  MultiSuperquadric model;
  model.parts.resize(2);
  model.parts[0].semi_axes = Eigen::Vector3d::Constant(0.1);
  model.parts[1].semi_axes = Eigen::Vector3d::Constant(0.05);
  model.parts[1].center = Eigen::Vector3d(0, 0, 0.3);
  const Eigen::Vector3d eye(0, 0, -1), front(0, 0, 0.25);
  EXPECT_TRUE(isHidden(model, front, eye, 1e-6));                         // behind
  EXPECT_FALSE(isHidden(model, front, Eigen::Vector3d(2, 0, 0.2), 1e-6)); // beside
  EXPECT_FALSE(isHidden(model, Eigen::Vector3d(0, 0, -0.1), eye, 1e-6));  // before
  model.parts[1].center = Eigen::Vector3d::Zero();
  EXPECT_TRUE(isHidden(model, Eigen::Vector3d(0, 0, -0.05), eye, 1e-6)); // inside
}
