// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/display/display_surface.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pcl_sq;

namespace {

double volumeOf(const DisplaySurface& surface, const Eigen::Vector3d& center) {
  double six_volumes = 0.0;
  for (const auto& t : surface.triangles)
    six_volumes += (surface.vertices[t[0]] - center)
                       .dot((surface.vertices[t[1]] - center)
                                .cross(surface.vertices[t[2]] - center));
  return six_volumes / 6.0;
}

Superquadric unit(double epsilon1, double epsilon2) {
  Superquadric s;
  s.epsilon1 = epsilon1;
  s.epsilon2 = epsilon2;
  return s;
}

} // namespace

TEST(DisplaySurface, VerticesLieOnTheSuperquadric) {
  test::Random random(1);
  for (int i = 0; i < 30; ++i) {
    const Superquadric s = random.superquadric();
    for (const Eigen::Vector3d& v : displaySurface(s).vertices)
      EXPECT_NEAR(s.gauge(v), 1.0, 1e-9);
  }
}

TEST(DisplaySurface, TrianglesEncloseTheVolumeAndLookOutwards) {
  test::Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Superquadric s = random.superquadric();
    const DisplaySurface surface = displaySurface(s);
    const double volume = volumeOf(surface, s.center);
    EXPECT_LE(volume, s.volume() * (1 + 1e-9)); // inscribed in a convex body
    EXPECT_GE(volume, s.volume() * 0.985) << s.epsilon1 << " " << s.epsilon2;
  }
}

TEST(DisplaySurface, NormalsAreTheGradientsDirection) {
  test::Random random(3);
  for (int i = 0; i < 30; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.3, 1.7);
    s.epsilon2 = random.uniform(0.3, 1.7);
    const DisplaySurface surface = displaySurface(s);
    for (std::size_t k = 0; k < surface.vertices.size(); ++k) {
      EXPECT_NEAR(surface.normals[k].norm(), 1.0, 1e-9);
      const Eigen::Vector3d local =
          s.toLocal(surface.vertices[k]).cwiseAbs().cwiseQuotient(s.semi_axes);
      if (local.minCoeff() > 1e-3) { // the gradient is not unique on the axes
        EXPECT_LT((surface.normals[k] - s.normal(surface.vertices[k])).norm(), 1e-6);
      }
    }
  }
}

TEST(DisplaySurface, SharpBodiesGetTheirEdgesDrawnAndSmoothOnesNone) {
  EXPECT_TRUE(displaySurface(unit(1.0, 1.0)).edges.empty());
  EXPECT_EQ(displaySurface(unit(0.05, 1.0)).edges.size(), 2u);  // a can's two rims
  EXPECT_EQ(displaySurface(unit(0.05, 0.05)).edges.size(), 6u); // 2 rings, 4 ribs
  EXPECT_EQ(displaySurface(unit(2.0, 2.0)).edges.size(), 5u);   // belt, 4 ribs
}

TEST(DisplaySurface, EdgesOfABoxRunAlongTheBoxsEdges) {
  Superquadric box = unit(0.05, 0.05);
  box.semi_axes = {0.1, 0.2, 0.3};
  const DisplaySurface surface = displaySurface(box);
  for (const auto& edge : surface.edges)
    for (const std::uint32_t i : edge) {
      // at least two coordinates are extreme on an edge
      Eigen::Array3d share =
          surface.vertices[i].cwiseAbs().cwiseQuotient(box.semi_axes).array();
      EXPECT_GE((share > 0.96).count(), 2) << share.transpose();
    }
}

TEST(DisplaySurface, OutlineOfABallIsAGreatCircle) {
  const DisplaySurface ball = displaySurface(unit(1.0, 1.0));
  const Eigen::Vector3d to_eye = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const auto ends =
      outline(ball, std::vector<Eigen::Vector3d>(ball.vertices.size(), to_eye));
  ASSERT_GE(ends.size(), 100u);
  double length = 0.0;
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    EXPECT_NEAR(ends[i].norm(), 1.0, 2e-3);
    EXPECT_NEAR(ends[i].dot(to_eye), 0.0, 2e-3);
    length += (ends[i] - ends[i + 1]).norm();
  }
  EXPECT_NEAR(length, 2.0 * M_PI, 0.02);
}
