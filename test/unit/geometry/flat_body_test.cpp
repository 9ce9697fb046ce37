// SPDX-License-Identifier: BSD-3-Clause
// Feet of points near the edges of flat bodies and of rods (M4).
#include "pcl_sq/superquadric.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace pcl_sq;

namespace {

/** \brief A book, with its short axis along \a thin. */
Superquadric book(int thin) {
  Superquadric s;
  s.semi_axes = {0.11, 0.13, 0.15};
  s.semi_axes[thin] = 0.0075;
  s.epsilon1 = s.epsilon2 = 0.05;
  return s;
}

/** \brief A point \a depth under the middle of a face, \a beside its edge. */
Eigen::Vector3d
under(const Superquadric& s, int face, int edge, double depth, double beside) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  p[face] = s.semi_axes[face] - depth;
  p[edge] = s.semi_axes[edge] - beside;
  return p;
}

} // namespace

TEST(FlatBody, APointUnderItsFaceIsAsFarAsItLiesUpToTheEdge) {
  for (int thin = 0; thin < 3; ++thin) {
    const Superquadric s = book(thin);
    for (int edge = 0; edge < 3; ++edge) {
      if (edge == thin)
        continue;
      for (const double beside : {0.003, 0.005, 0.01, 0.05})
        for (const double depth : {-0.0006, 0.0003, 0.0006, 0.001}) {
          const Eigen::Vector3d p = under(s, thin, edge, depth, beside);
          // the gauge alone takes it for a point of the narrow side, up to ten times as
          // far
          const double exact = s.euclideanDistance(p), foot = s.footPointDistance(p);
          EXPECT_GT(foot * exact, 0.0);
          EXPECT_LT(std::abs(foot), 2.0 * std::abs(exact) + 5e-5)
              << "thin " << thin << " edge " << edge << " beside " << beside;
        }
    }
  }
}

TEST(FlatBody, ARodsSidesAreAsFarNearItsEnds) {
  for (int along = 0; along < 3; ++along) {
    Superquadric s;
    s.semi_axes = {0.01, 0.012, 0.014};
    s.semi_axes[along] = 0.3;
    s.epsilon1 = s.epsilon2 = 0.1;
    for (int face = 0; face < 3; ++face)
      if (face != along)
        for (const double beside : {0.004, 0.01, 0.1}) {
          const Eigen::Vector3d p = under(s, face, along, 0.0008, beside);
          EXPECT_NEAR(s.footPointDistance(p), s.euclideanDistance(p), 1e-4)
              << "along " << along << " face " << face << " beside " << beside;
        }
  }
}

TEST(FlatBody, ATaperedBoardIsAsNearAsItsFaceUpToTheEdge) {
  for (int thin = 0; thin < 3; ++thin) {
    Superquadric s = book(thin);
    s.kx = 0.2;
    s.ky = -0.1;
    for (int edge = 0; edge < 3; ++edge) {
      if (edge == thin)
        continue;
      for (const double beside : {0.03, 0.05, 0.08})
        for (const double depth : {-0.0006, 0.0006, 0.001}) {
          Eigen::Vector3d p = under(s, thin, edge, depth, beside);
          p.x() *= 1.0 + s.kx * p.z() / s.semi_axes.z(); // of the tapered body
          p.y() *= 1.0 + s.ky * p.z() / s.semi_axes.z();
          const double exact = s.euclideanDistance(p), foot = s.footPointDistance(p);
          EXPECT_GT(foot * exact, 0.0);
          EXPECT_LT(std::abs(foot), 2.0 * std::abs(exact) + 5e-5)
              << "thin " << thin << " edge " << edge << " beside " << beside;
        }
    }
  }
}

TEST(FlatBody, AFootIsNeverFartherThanTheRadialOne) {
  std::array<double, 3> sides{0.02, 0.1, 0.3};
  for (const double e : {0.1, 0.5, 1.0})
    for (int k = 0; k < 200; ++k) {
      Superquadric s;
      s.semi_axes = {sides[std::size_t(k % 3)],
                     sides[std::size_t((k + 1) % 3)],
                     sides[std::size_t((k + 2) % 3)]};
      s.epsilon1 = e;
      s.epsilon2 = 1.1 - 0.4 * e;
      const Eigen::Vector3d direction(
          std::sin(1.7 * k), std::cos(2.3 * k), std::sin(0.9 * k + 1.0));
      const Eigen::Vector3d p =
          (0.6 + 0.01 * (k % 80)) * direction.cwiseProduct(s.semi_axes);
      EXPECT_LE(std::abs(s.footPointDistance(p)), std::abs(s.radialDistance(p)) + 1e-9);
    }
}
