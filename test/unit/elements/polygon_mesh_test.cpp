// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/polygon_mesh.h"

#include <gtest/gtest.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

using namespace pcl_sq;

namespace {

/** \brief Volume by the divergence theorem: right only for a closed surface whose
 * triangles are counter-clockwise seen from outside. */
double volumeOf(const pcl::PolygonMesh& mesh) {
  pcl::PointCloud<pcl::PointXYZ> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  double volume = 0.0;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    EXPECT_EQ(polygon.vertices.size(), 3u);
    const auto corner = [&](std::size_t k) {
      return vertices.at(std::size_t(polygon.vertices[k]))
          .getVector3fMap()
          .cast<double>()
          .eval();
    };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
  }
  return volume;
}

} // namespace

TEST(PolygonMesh, HoldsTheVolumeOfItsSuperquadric) {
  Superquadric s;
  s.center = {0.2, -0.1, 0.7};
  s.semi_axes = {0.03, 0.04, 0.08};
  s.epsilon1 = 0.4;
  EXPECT_NEAR(volumeOf(toPolygonMesh(s, 48)) / s.volume(), 1.0, 0.01);
}

TEST(PolygonMesh, OfAUnionHasNoInnerWalls) {
  Superquadric ball;
  ball.semi_axes.setConstant(0.05);
  MultiSuperquadric twice;
  twice.parts = {ball, ball}; // counted once
  EXPECT_NEAR(volumeOf(toPolygonMesh(twice)) / ball.volume(), 1.0, 0.02);
}

TEST(PolygonMesh, OfNothingIsEmptyButStillPcls) {
  const pcl::PolygonMesh mesh = toPolygonMesh(TriangleMesh());
  EXPECT_TRUE(mesh.polygons.empty());
  EXPECT_EQ(mesh.cloud.width * mesh.cloud.height, 0u);
  EXPECT_EQ(mesh.cloud.fields.size(), 3u); // x, y, z: PCL's readers ask for them
}
