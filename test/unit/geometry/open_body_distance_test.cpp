// SPDX-License-Identifier: BSD-3-Clause
// Distances to bodies with a rim: to the mesh, in the half plane, of many points.
#include "geometry/open_body.h"
#include "kernels/kernels.h"

#include "mesh_laws.h"
#include "open_body.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::anyOpenBody;
using pcl_sq::test::Random;
using pcl_sq::test::rounded;

TEST(OpenBody, ClosestPointIsThatOfTheMesh) {
  Random random(3);
  for (int trial = 0; trial < 24; ++trial) {
    const Superquadric s = anyOpenBody(random, trial % 3 != 0);
    const TriangleMesh mesh = meshSuperquadric(s, 96);
    const Eigen::Vector3d p = random.pointNear(s);
    // chords of 96 divisions lie this far off the surface
    const double sagitta = 2e-3 * s.semi_axes.maxCoeff();
    EXPECT_NEAR((s.closestPoint(p) - p).norm(), test::distanceTo(mesh, p), sagitta)
        << trial;
    EXPECT_EQ(s.euclideanDistance(p) <= 0.0, s.inMaterial(p)) << trial;
  }
}

TEST(OpenBody, DistanceInTheHalfPlaneIsEuclideanForSolidsOfRevolution) {
  Random random(4);
  for (int trial = 0; trial < 60; ++trial) {
    const bool round = trial % 2 == 0;
    Superquadric s = anyOpenBody(random, trial % 3 != 0);
    if (round)
      s = rounded(s);
    const Eigen::Vector3d p = random.pointNear(s);
    const double exact = std::copysign((p - s.closestPoint(p)).norm(),
                                       s.inMaterial(p) ? -1.0 : 1.0),
                 fast = s.footPointDistance(p);
    EXPECT_GE(std::abs(fast), std::abs(exact) - 1e-5);
    EXPECT_EQ(fast > 0.0, exact > 0.0);
    if (round) {
      EXPECT_NEAR(fast, exact, 1e-4) << trial;
    }
  }
}

TEST(OpenBody, ManyPointsHaveTheSameDistancesAsEachOfThem) {
  using namespace pcl_sq::kernels;
  Random random(6);
  for (int trial = 0; trial < 40; ++trial) {
    Superquadric s = rounded(anyOpenBody(random, trial % 3 != 0));
    s.semi_axes /= s.semi_axes.maxCoeff();
    s.wall = std::min(s.wall, 0.1);
    s.center = random.direction();
    const detail::Meridian searched(s, Eigen::Vector2d::UnitX());
    detail::UnitPoints points;
    points.reserve(301);
    for (int i = 0; i < 301; ++i) {
      const Eigen::Vector3f p = random.pointNear(s).cast<float>();
      points.add(p.x(), p.y(), p.z());
    }
    std::vector<float> numbers, distances(points.size());
    const Outline outline = searched.table(numbers);
    for (const Isa isa : {Isa::PORTABLE, Isa::SSE2, Isa::AVX2, Isa::AVX512}) {
      const Kernels* kernels = kernelsFor(isa);
      if (!kernels)
        continue;
      kernels->outlineDistances(
          points.view(), detail::toShape(s), outline, distances.data());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d p = s.toLocal(points[i].cast<double>());
        const double expected = searched.distance(p.head<2>().norm(), p.z());
        EXPECT_NEAR(std::abs(double(distances[i])), std::abs(expected), 5e-5) << trial;
        if (std::abs(expected) > 5e-5) {
          EXPECT_EQ(distances[i] > 0.0F, expected > 0.0) << trial;
        }
      }
    }
  }
}
